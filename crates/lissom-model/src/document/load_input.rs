//! A load whose size becomes an input: a unit of the input is a unit of the size.

use lissom_mechanics::elements::LOADS;
use lissom_mechanics::registry::{ParameterType, Value};

use super::Document;
use crate::expression::Formula;
use crate::text::report::Located;

impl Document {
    /// This model with a load's size a new input, which is last among the inputs; none where no load is called so.
    pub fn with_load_as_input(&self, load: &str) -> Option<Self> {
        let index = self.loads.iter().position(|own| own.name.value == load)?;
        let kind = LOADS.iter().find(|kind| kind.name == self.loads[index].kind.value)?;
        let size = kind.parameters.iter().find(|parameter| parameter.holds == ParameterType::Size)?;
        let mut document = self.clone();
        let mut input = "size_of_load".to_owned();
        while self.is_taken(&input) {
            input.push('_');
        }
        let own = &mut document.loads[index];
        let formula = Formula::parse(&input, &document.parameters).ok()?;
        own.signal = Some((size.name, Located::new(formula, own.name.span)));
        // The load of size one is multiplied.
        own.parameters.insert(size.name, Value::Number(1.0));
        let span = own.name.span;
        document.inputs.push((Located::new(input, span), 0.0));
        Some(document)
    }

    fn is_taken(&self, name: &str) -> bool {
        let inputs = self.inputs.iter().map(|(input, _)| &input.value);
        let signals = self.signals.iter().map(|signal| &signal.name.value);
        let states = self.states.iter().map(|state| &state.name.value);
        inputs.chain(signals).chain(states).chain(self.parameters.keys()).any(|taken| taken == name)
    }
}
