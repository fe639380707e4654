//! Published test cases with exact answers, where a folder of them is at
//! hand: `UMRISS_CLIPPING_CASES` names it.
//!
//! Each line of `cases.jsonl` is a case: operands, a fill rule, and for each
//! operation the exact area (as a rational number, or 50 digits), how many
//! connected areas there are, and how many bounded ones around them.

use super::rounding::perimeter;
use super::validity::fault;
use glam::{DVec2, dvec2};
use serde_json::Value;
use std::path::Path;
use umriss::kernel::numbers::Fraction;
use umriss::polygon::clipping::{FillRule, Operation, PlaneShape};

const OPERATIONS: [(&str, Operation); 4] = [
    ("intersection", Operation::Intersection),
    ("union", Operation::Union),
    ("difference", Operation::Difference),
    ("xor", Operation::Xor),
];

fn shape(operand: &Value, rule: FillRule) -> PlaneShape {
    let list = |value: &Value| value.as_array().unwrap().clone();
    let corner = |value: &Value| dvec2(value[0].as_f64().unwrap(), value[1].as_f64().unwrap());
    let ring = |value: &Value| -> Vec<DVec2> { list(value).iter().map(corner).collect() };
    let polygon = |value: &Value| list(value).iter().map(ring).collect();
    let polygons: Vec<Vec<Vec<DVec2>>> = list(operand).iter().map(polygon).collect();
    PlaneShape::new(&polygons, rule).unwrap()
}

/// Whether an area is that of a text of 50 digits, or of a quotient.
fn is_area(area: &Fraction, expected: &Value) -> bool {
    if let Some(text) = expected["area_rational"].as_str() {
        return area.to_string() == text;
    }
    let text = expected["area_50"].as_str().unwrap();
    let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
    let (whole, places) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let power = |exponent: i64| {
        (0..exponent.unsigned_abs())
            .fold(Fraction::whole(1.into()), |p, _| p * Fraction::whole(10.into()))
    };
    let digits = whole.chars().chain(places.chars()).filter(char::is_ascii_digit);
    let integer = digits.fold(Fraction::zero(), |sum, digit| {
        sum * Fraction::whole(10.into()) + Fraction::whole(i64::from(digit as u8 - b'0').into())
    });
    let exponent = exponent.parse::<i64>().unwrap() - places.len() as i64;
    // 50 digits, the last of which is rounded.
    let (value, error) = (integer.clone(), Fraction::whole(1.into()));
    let scaled = if exponent >= 0 {
        return area.clone() == value * power(exponent);
    } else {
        area.clone() * power(exponent)
    };
    (scaled - value).abs() <= error
}

/// The bounded areas around a shape: those of a large frame without it, but
/// for the one that touches the frame.
fn areas_around(shape: &PlaneShape) -> usize {
    let far = 1e12;
    let frame = vec![dvec2(-far, -far), dvec2(far, -far), dvec2(far, far), dvec2(-far, far)];
    let frame = PlaneShape::new(&[vec![frame]], FillRule::NonZero).unwrap();
    let around = PlaneShape::operation(Operation::Difference, &[&frame, shape]).unwrap();
    around.polygons().len() - 1
}

#[test]
fn published_cases_have_their_exact_answers() {
    let Ok(folder) = std::env::var("UMRISS_CLIPPING_CASES") else {
        println!("skipped: UMRISS_CLIPPING_CASES names no folder of cases");
        return;
    };
    let text = std::fs::read_to_string(Path::new(&folder).join("cases.jsonl")).unwrap();
    let (mut wrong, mut checked) = (Vec::new(), 0);
    for line in text.lines().filter(|line| !line.trim().is_empty()) {
        let case: Value = serde_json::from_str(line).unwrap();
        let rule = match case["fill"].as_str().unwrap() {
            "evenodd" => FillRule::EvenOdd,
            "nonzero" => FillRule::NonZero,
            "positive" => FillRule::Positive,
            "negative" => FillRule::Negative,
            "polyset" => FillRule::Polygons,
            other => panic!("unknown rule {other}"),
        };
        let operands = case["operands"].as_array().unwrap();
        let shapes: Vec<PlaneShape> = operands.iter().map(|operand| shape(operand, rule)).collect();
        let shapes: Vec<&PlaneShape> = shapes.iter().collect();
        for (name, operation) in OPERATIONS {
            let expected = &case["exact"][name];
            if expected.is_null() {
                continue;
            }
            checked += 1;
            let id = format!("{} {name}", case["id"]);
            let result = PlaneShape::operation(operation, &shapes).unwrap();
            let area = result.area();
            if !is_area(&area, expected) {
                wrong.push(format!("{id}: area {} and not {expected}", area.to_f64()));
            }
            let components = expected["components"].as_u64().unwrap() as usize;
            if result.polygons().len() != components {
                let count = result.polygons().len();
                wrong.push(format!("{id}: {count} areas and not {components}"));
            }
            let around = expected["bounded_complement_components"].as_u64().unwrap() as usize;
            if areas_around(&result) != around {
                wrong.push(format!("{id}: {} areas around, not {around}", areas_around(&result)));
            }
            let rounded = result.rounded().unwrap();
            if let Some(fault) = fault(&rounded) {
                wrong.push(format!("{id}: rounded: {fault}"));
            }
            let again = PlaneShape::new(&rounded.polygons, FillRule::Positive).unwrap();
            let places = result.positions().into_iter().flatten().flatten().flatten();
            let largest = places.map(|place| place.to_f64().abs()).fold(0.0, f64::max);
            let perimeter = perimeter(&result);
            let error = (again.area() - area).abs().to_f64();
            if error > 4.0 * perimeter * largest * f64::EPSILON / 2.0 {
                wrong.push(format!("{id}: rounded: area off by {error}"));
            }
        }
    }
    println!("{checked} operations checked");
    assert!(wrong.is_empty(), "{} wrong:\n{}", wrong.len(), wrong.join("\n"));
}
