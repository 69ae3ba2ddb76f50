//! Reads an expression by descent over its precedence levels and writes the steps of a stack machine.

use std::collections::BTreeMap;
use std::ops::Range;

use super::error::ExpressionError;
use super::formula::Name;
use super::jet::{self, Function};
use super::program::{STACK, Step, run};
use super::token::{Placed, Token, tokens};
use crate::format::{suggest, synonyms};

/// Nesting that is still read; deeper texts are machine-made.
const DEPTH: usize = 100;

/// Reads `text`. Names that are neither the variable nor parameters are collected in `arguments`, if it is there, and
/// unknown otherwise.
pub(super) fn compile(
    text: &str,
    variable: Option<&str>,
    parameters: &BTreeMap<String, f64>,
    arguments: Option<&mut Vec<Name>>,
) -> Result<Vec<Step>, ExpressionError> {
    let tokens = tokens(text)?;
    if tokens.len() == 1 {
        return error("the expression is empty", 0..text.len());
    }
    let mut reader = Reader { tokens, at: 0, steps: Vec::new(), variable, parameters, arguments, depth: 0 };
    reader.comparison()?;
    match reader.next() {
        (Token::End, _) => {}
        (token, range) => {
            let unit = match &token {
                Token::Name(name) => synonyms::instead_of_unit(name),
                _ => None,
            };
            let help = unit.unwrap_or("write products with `*`, as in `2*t`").to_owned();
            let message = format!("unexpected {} after a complete expression", describe(&token));
            return Err(ExpressionError { message, help: Some(help), range });
        }
    }
    let steps = fold(reader.steps);
    let mut height = 0;
    for step in &steps {
        height = height + 1 - step.operands();
        if height >= STACK {
            return error("the expression is nested too deeply", 0..text.len());
        }
    }
    Ok(steps)
}

fn error<T>(message: impl Into<String>, range: Range<usize>) -> Result<T, ExpressionError> {
    Err(ExpressionError { message: message.into(), help: None, range })
}

fn describe(token: &Token<'_>) -> String {
    match token {
        Token::Number(value) => format!("number `{value}`"),
        Token::Name(name) => format!("name `{name}`"),
        Token::Sign(sign) => format!("`{sign}`"),
        Token::End => "end".to_owned(),
    }
}

struct Reader<'t, 'p, 'n> {
    tokens: Vec<Placed<'t>>,
    at: usize,
    steps: Vec<Step>,
    variable: Option<&'p str>,
    parameters: &'p BTreeMap<String, f64>,
    arguments: Option<&'n mut Vec<Name>>,
    depth: usize,
}

impl<'t> Reader<'t, '_, '_> {
    fn peek(&self) -> &Token<'t> {
        &self.tokens[self.at].0
    }

    /// The next token; the end is never passed.
    fn next(&mut self) -> Placed<'t> {
        let token = self.tokens[self.at].clone();
        self.at = (self.at + 1).min(self.tokens.len() - 1);
        token
    }

    fn take(&mut self, sign: char) -> bool {
        let found = *self.peek() == Token::Sign(sign);
        if found {
            self.next();
        }
        found
    }

    /// A comparison, 1 where it holds and 0 elsewhere, or a sum.
    fn comparison(&mut self) -> Result<(), ExpressionError> {
        self.sum()?;
        let function = match self.peek() {
            Token::Sign('<') => Function::Less,
            Token::Sign('>') => Function::Greater,
            Token::Sign('≤') => Function::LessOrEqual,
            Token::Sign('≥') => Function::GreaterOrEqual,
            _ => return Ok(()),
        };
        self.next();
        self.sum()?;
        self.steps.push(Step::Call2(function));
        Ok(())
    }

    fn sum(&mut self) -> Result<(), ExpressionError> {
        self.product()?;
        loop {
            let step = match self.peek() {
                Token::Sign('+') => Step::Add,
                Token::Sign('-') => Step::Subtract,
                _ => return Ok(()),
            };
            self.next();
            self.product()?;
            self.steps.push(step);
        }
    }

    fn product(&mut self) -> Result<(), ExpressionError> {
        self.signed()?;
        loop {
            let step = match self.peek() {
                Token::Sign('*') => Step::Multiply,
                Token::Sign('/') => Step::Divide,
                _ => return Ok(()),
            };
            self.next();
            self.signed()?;
            self.steps.push(step);
        }
    }

    /// A sign binds less than a power, so `-t^2` is `-(t^2)`.
    fn signed(&mut self) -> Result<(), ExpressionError> {
        self.depth += 1;
        if self.depth > DEPTH {
            return error("the expression is nested too deeply", self.tokens[self.at].1.clone());
        }
        if self.take('-') {
            self.signed()?;
            self.steps.push(Step::Negate);
        } else if self.take('+') {
            self.signed()?;
        } else {
            self.power()?;
        }
        self.depth -= 1;
        Ok(())
    }

    /// Powers group to the right.
    fn power(&mut self) -> Result<(), ExpressionError> {
        self.value()?;
        if self.take('^') {
            self.signed()?;
            self.steps.push(Step::Power);
        }
        Ok(())
    }

    fn value(&mut self) -> Result<(), ExpressionError> {
        let (token, range) = self.next();
        match token {
            Token::Number(value) => self.steps.push(Step::Constant(value)),
            Token::Name(name) => match Function::named(name) {
                Some(function) => self.call(function, range)?,
                None => self.name(name, range)?,
            },
            Token::Sign('(') => {
                self.comparison()?;
                self.close()?;
            }
            other => {
                return error(format!("expected a value, found {}", describe(&other)), range);
            }
        }
        Ok(())
    }

    fn close(&mut self) -> Result<(), ExpressionError> {
        if self.take(')') {
            return Ok(());
        }
        let (found, range) = self.tokens[self.at].clone();
        error(format!("expected a closing parenthesis `)`, found {}", describe(&found)), range)
    }

    fn name(&mut self, name: &str, range: Range<usize>) -> Result<(), ExpressionError> {
        let step = if Some(name) == self.variable {
            Some(Step::Variable)
        } else if name == "pi" {
            Some(Step::Constant(std::f64::consts::PI))
        } else {
            self.parameters.get(name).map(|value| Step::Constant(*value))
        };
        if let Some(step) = step {
            self.steps.push(step);
            return Ok(());
        }
        if *self.peek() == Token::Sign('(') {
            let help = suggest::help(name, jet::NAMES.iter().map(|(known, _)| *known));
            return Err(ExpressionError { message: format!("unknown function `{name}`"), help, range });
        }
        if let Some(arguments) = &mut self.arguments {
            let index = arguments.iter().position(|known| known.text == name).unwrap_or_else(|| {
                arguments.push(Name { text: name.to_owned(), range });
                arguments.len() - 1
            });
            self.steps.push(Step::Argument(index));
            return Ok(());
        }
        let known = self.variable.into_iter().chain(["pi"]).chain(self.parameters.keys().map(String::as_str));
        let unit = synonyms::instead_of_unit(name).map(str::to_owned);
        let is_of_time = self.variable == Some("t");
        let of_time = |help: String| match help.strip_prefix("known here") {
            Some(_) if is_of_time => format!(
                "{help}; this depends on time alone: what follows states, inputs or motions is a load, such as `joint_torque`"
            ),
            _ => help,
        };
        let help = unit.or_else(|| suggest::help(name, known).map(of_time));
        Err(ExpressionError { message: format!("unknown name `{name}`"), help, range })
    }

    fn call(&mut self, function: Function, name: Range<usize>) -> Result<(), ExpressionError> {
        if !self.take('(') {
            let (found, range) = self.tokens[self.at].clone();
            let message =
                format!("a function takes its argument in parentheses, but here is {}", describe(&found));
            let help = Some("write for example `sin(2*t)`".to_owned());
            return Err(ExpressionError { message, help, range });
        }
        self.comparison()?;
        let mut count = 1;
        while self.take(',') {
            self.comparison()?;
            count += 1;
            if function.arguments() == 2 {
                self.steps.push(Step::Call2(function));
            }
        }
        self.close()?;
        let range = name.start..self.tokens[self.at - 1].1.end;
        let wanted = function.arguments();
        if function.takes_many() && count >= 2 {
            return Ok(());
        }
        if count != wanted {
            return error(format!("this function takes {wanted} argument(s), not {count}"), range);
        }
        match wanted {
            1 => self.steps.push(Step::Call(function)),
            3 => self.steps.push(Step::Call3(function)),
            _ => {}
        }
        Ok(())
    }
}

/// Replaces every step on constants by its result.
pub(super) fn fold(steps: Vec<Step>) -> Vec<Step> {
    let mut folded: Vec<Step> = Vec::with_capacity(steps.len());
    for step in steps {
        let operands = step.operands();
        folded.push(step);
        let from = folded.len() - 1 - operands.min(folded.len() - 1);
        let constant = |step: &Step| matches!(step, Step::Constant(_));
        if operands > 0 && folded[from..folded.len() - 1].iter().all(constant) {
            let value = run(&folded.split_off(from), 0.0, |_| 0.0);
            folded.push(Step::Constant(value));
        }
    }
    folded
}
