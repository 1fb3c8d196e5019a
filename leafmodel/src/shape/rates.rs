//! Growth functions: `[[place, rate], …]`.

use crate::document::schema::Type;
use crate::document::values::{list, number, number_at, wrong_length, wrong_type};
use crate::document::{Context, DocumentError, Kind, Limits, Node, Value};
use crate::shape::growth::RateCurve;

/// A rate over a place from 0 to 1.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rates;

impl Rates {
    const WANTED: &str = "a list of 1 to 1000 pairs [place, rate]";
    const PLACES: Limits = Limits::closed(0.0, 1.0);
    // At -1 tissue would shrink to nothing in one step.
    const RATES: Limits = Limits::above(-1.0, 1.0);
}

impl Kind for Rates {
    type Of = RateCurve;

    fn read(&self, cx: &Context, node: &Node, key: &str) -> Option<RateCurve> {
        let Value::List(nodes) = &node.value else {
            wrong_type(cx, node, key, Self::WANTED);
            return None;
        };
        if !(1..=1000).contains(&nodes.len()) {
            wrong_length(cx, &node.at, key, "a list", nodes.len(), Self::WANTED);
            return None;
        }
        let errors = cx.error_count();
        let mut knots: Vec<[f64; 2]> = Vec::with_capacity(nodes.len());
        for pair in nodes {
            let Some([place_node, rate_node]) = pair_of(pair) else {
                wrong_type(cx, pair, key, "a pair [place, rate]");
                continue;
            };
            let place = number_at(cx, place_node, &format!("{key}, place"), Self::PLACES);
            let rate = number_at(cx, rate_node, &format!("{key}, rate"), Self::RATES);
            let (Some(place), Some(rate)) = (place, rate) else {
                continue;
            };
            if let Some([last, _]) = knots.last().copied().filter(|[last, _]| *last >= place) {
                let error = DocumentError::NotRising {
                    key: format!("{key}, place"),
                    before: last,
                    after: place,
                };
                cx.error(&place_node.at, error);
                break;
            }
            knots.push([place, rate]);
        }
        if cx.error_count() > errors {
            return None;
        }
        let curve = RateCurve::new(knots).map_err(|error| {
            let error = DocumentError::Impossible {
                key: key.to_owned(),
                problem: error.to_string(),
                help: format!("write {}", Self::WANTED),
            };
            cx.error(&node.at, error);
        });
        curve.ok()
    }

    fn write(&self, curve: &RateCurve) -> Value {
        list(curve.knots().iter().map(|knot| list(knot.map(number))))
    }

    fn describe(&self) -> Type {
        let pair = vec![Type::Number(Self::PLACES), Type::Number(Self::RATES)];
        Type::List {
            of: Box::new(Type::Tuple(pair)),
            least: 1,
            most: 1000,
            wanted: Self::WANTED,
        }
    }
}

/// The two values of a list of two.
fn pair_of(node: &Node) -> Option<[&Node; 2]> {
    let Value::List(nodes) = &node.value else {
        return None;
    };
    match nodes.as_slice() {
        [first, second] => Some([first, second]),
        _ => None,
    }
}
