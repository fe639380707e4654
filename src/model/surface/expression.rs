//! Heights from an expression of x and z.

use super::powers::bind_powers;
use super::{Heights, SurfaceError};
use crate::run::map_indexed;
use exmex::{Express, FlatEx};

impl Heights {
    /// The values of an expression such as `sin(x)*cos(z)` at the points of
    /// a grid; missing where it has no finite value. O(n).
    ///
    /// Operators are those of the crate exmex: + - * / ^, functions such as
    /// sin, cos, exp, ln, sqrt, abs, and the constants PI and E. Powers bind
    /// as mathematicians write them: `-x^2` is -(x^2), `x^y^2` is x^(y^2).
    ///
    /// # Errors
    ///
    /// If it cannot be read or has other variables, or as [`Heights::new`].
    pub fn of_expression(text: &str, xs: Vec<f64>, zs: Vec<f64>) -> Result<Self, SurfaceError> {
        let wrong = |message: String| SurfaceError::Expression { text: text.to_owned(), message };
        let expression =
            FlatEx::<f64>::parse(&bind_powers(text)).map_err(|error| wrong(error.to_string()))?;
        // Variables are passed in the order in which the crate lists them.
        let mut axes = Vec::new();
        for name in expression.var_names() {
            match name.as_str() {
                "x" => axes.push(0),
                "z" => axes.push(1),
                other => return Err(wrong(format!("'{other}' is no variable"))),
            }
        }
        let row = |j: usize| -> Result<Vec<f64>, SurfaceError> {
            let value = |&x: &f64| {
                let place = [x, zs[j]];
                let arguments = axes.iter().map(|&axis: &usize| place[axis]);
                let mut values = [0.0; 2];
                let count = axes.len().min(2);
                values.iter_mut().zip(arguments).for_each(|(slot, value)| *slot = value);
                expression.eval(&values[..count]).map_err(|error| wrong(error.to_string()))
            };
            xs.iter().map(value).collect()
        };
        let rows: Result<Vec<_>, _> = map_indexed(zs.len(), row).into_iter().collect();
        let values = rows?.concat();
        Heights::new(xs, zs, values)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(text: &str) -> Result<Vec<f64>, String> {
        let heights = Heights::of_expression(text, vec![0.0, 1.0, 2.0], vec![3.0, 5.0]);
        heights.map(|heights| heights.values().to_vec()).map_err(|error| error.to_string())
    }

    #[test]
    fn variables_are_told_apart_by_name() {
        assert_eq!(values("z*10 + x").unwrap(), [30.0, 31.0, 32.0, 50.0, 51.0, 52.0]);
        assert_eq!(values("-x^2").unwrap(), [0.0, -1.0, -4.0, 0.0, -1.0, -4.0]);
        assert_eq!(values("z").unwrap(), [3.0, 3.0, 3.0, 5.0, 5.0, 5.0]);
        assert_eq!(values("7").unwrap(), [7.0; 6]);
        assert_eq!(values("8/2*4-1.5E+1 + 0*x").unwrap(), [1.0; 6]);
        assert_eq!(values("2^3^2 - 2*-x^2/-1 + 2*x^2 + 2^-1").unwrap(), [512.5; 6]);
        assert_eq!(values("-(1+x)^2 + (x+1)^2 + sqrt(z)^2").unwrap()[0], 3_f64.sqrt().powf(2.0));
        let found = values("sin(x)*cos(z)").unwrap();
        assert_eq!(found[4], 1_f64.sin() * 5_f64.cos());
    }

    #[test]
    fn what_has_no_finite_value_is_missing() {
        let found = values("1/x").unwrap();
        assert!(found[0].is_nan() && found[1] == 1.0);
        assert!(values("sqrt(x-1.5)").unwrap()[1].is_nan());
    }

    #[test]
    fn other_variables_and_broken_expressions_are_refused() {
        assert_eq!(
            values("x*t").unwrap_err(),
            "'x*t': 't' is no variable, expected an expression of x and z as in sin(x)*cos(z)"
        );
        let error = values("sin(x").unwrap_err();
        assert!(error.starts_with("'sin(x': "), "{error}");
        assert!(error.ends_with(", expected an expression of x and z as in sin(x)*cos(z)"));
        assert!(values("").is_err());
        assert!(values("x +").is_err());
        for text in [
            "(", ")", "()", ",", "x,z", "^", "x^", "^x", "-", "ü!§^", "ä", "{", "{x", "}", "sin",
            "sin()", "x z", "2x", "..", "1.2.3", "1e", "x(z)", "max(x)", "max(x,", "\u{0}", "x\nz",
            "é^2", "x^^2", "((x)",
        ] {
            let _ = values(text);
        }
    }
}
