//! Values that a function can return independent of its arguments.

use syn::{GenericArgument, PathArguments, ReturnType, Type};

/// Expressions of the type that a function returns; none where none can be named.
pub(super) fn values_of(output: &ReturnType) -> Vec<String> {
    match output {
        ReturnType::Default => vec!["()".to_owned()],
        ReturnType::Type(_, of) => values(of),
    }
}

fn values(of: &Type) -> Vec<String> {
    let own = |values: &[&str]| values.iter().map(|&value| value.to_owned()).collect();
    let each = |of: &Type, around: &dyn Fn(String) -> String| values(of).into_iter().map(around).collect();
    match of {
        Type::Path(path) => {
            let Some(last) = path.path.segments.last() else { return Vec::new() };
            let argument = match &last.arguments {
                PathArguments::AngleBracketed(several) => {
                    several.args.iter().find_map(|argument| match argument {
                        GenericArgument::Type(of) => Some(of),
                        _ => None,
                    })
                }
                _ => None,
            };
            match (last.ident.to_string().as_str(), argument) {
                ("bool", _) => own(&["true", "false"]),
                ("f64" | "f32", _) => own(&["0.0", "1.0", "-1.0"]),
                ("i8" | "i16" | "i32" | "i64" | "isize", _) => own(&["0", "1", "-1"]),
                ("u8" | "u16" | "u32" | "u64" | "usize", _) => own(&["0", "1"]),
                ("String", _) => own(&["String::new()", "\"xyzzy\".into()"]),
                ("Option", Some(of)) => {
                    let some: Vec<String> = each(of, &|value| format!("Some({value})"));
                    [own(&["None"]), some].concat()
                }
                ("Vec", Some(of)) => {
                    let one: Vec<String> = each(of, &|value| format!("vec![{value}]"));
                    [own(&["vec![]"]), one].concat()
                }
                ("Result", Some(of)) => each(of, &|value| format!("Ok({value})")),
                ("Result", None) => own(&["Ok(Default::default())"]),
                ("Box", Some(of)) => each(of, &|value| format!("Box::new({value})")),
                _ => own(&["Default::default()"]),
            }
        }
        Type::Reference(to) => match &*to.elem {
            Type::Path(path) if path.path.is_ident("str") => own(&["\"\"", "\"xyzzy\""]),
            Type::Slice(several) => {
                let one: Vec<String> = each(&several.elem, &|value| format!("Vec::leak(vec![{value}])"));
                [own(&["Vec::leak(vec![])"]), one].concat()
            }
            of => each(of, &|value| format!("Box::leak(Box::new({value}))")),
        },
        Type::Array(array) => each(&array.elem, &|value| format!("std::array::from_fn(|_| {value})")),
        Type::Tuple(several) => {
            let mut all = vec![Vec::new()];
            for of in &several.elems {
                let values = values(of);
                all = all
                    .iter()
                    .flat_map(|before| {
                        values.iter().map(move |value| [&before[..], std::slice::from_ref(value)].concat())
                    })
                    .collect();
            }
            all.iter().map(|tuple| format!("({})", tuple.join(", "))).collect()
        }
        _ => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_follow_from_the_type() {
        let values = |text: &str| values(&syn::parse_str(text).expect("it is a type"));
        assert_eq!(values("f64"), ["0.0", "1.0", "-1.0"]);
        assert_eq!(values("Result<Option<bool>, Error>"), ["Ok(None)", "Ok(Some(true))", "Ok(Some(false))"]);
        assert_eq!(
            values("(bool, Vector3<f64>)"),
            ["(true, Default::default())", "(false, Default::default())"]
        );
        assert_eq!(values("[usize; 2]"), ["std::array::from_fn(|_| 0)", "std::array::from_fn(|_| 1)"]);
        assert_eq!(values("&'static str"), ["\"\"", "\"xyzzy\""]);
        assert!(values("impl Iterator<Item = f64>").is_empty() && values("!").is_empty());
    }
}
