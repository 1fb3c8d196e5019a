//! Lists of numbers with a rule between them.

use glam::DVec2;

use super::context::Context;
use super::error::DocumentError;
use super::limits::Limits;
use super::schema::Type;
use super::tree::{Node, Value};
use super::value_kind::{Kind, Numbers};
use super::values::{list, number, number_at, numbers_at, wrong_length, wrong_type};

/// A list of numbers, each greater than the one before.
#[derive(Clone, Copy, Debug)]
pub struct Rising {
    /// The range of each.
    pub limits: Limits,
    /// How many there are at most.
    pub most: usize,
    /// What messages call the list.
    pub wanted: &'static str,
}

impl Kind for Rising {
    type Of = Vec<f64>;

    fn read(&self, cx: &Context, node: &Node, key: &str) -> Option<Vec<f64>> {
        let Value::List(nodes) = &node.value else {
            wrong_type(cx, node, key, self.wanted);
            return None;
        };
        if nodes.is_empty() || nodes.len() > self.most {
            wrong_length(cx, &node.at, key, "a list", nodes.len(), self.wanted);
            return None;
        }
        let errors = cx.error_count();
        let mut numbers: Vec<f64> = Vec::with_capacity(nodes.len());
        for node in nodes {
            let Some(value) = number_at(cx, node, key, self.limits) else {
                continue;
            };
            if let Some(&before) = numbers.last().filter(|before| **before >= value) {
                let error = DocumentError::NotRising {
                    key: key.to_owned(),
                    before,
                    after: value,
                };
                cx.error(&node.at, error);
                break;
            }
            numbers.push(value);
        }
        (cx.error_count() == errors).then_some(numbers)
    }

    fn write(&self, numbers: &Vec<f64>) -> Value {
        list(numbers.iter().copied().map(number))
    }

    fn describe(&self) -> Type {
        Type::List {
            of: Box::new(Type::Number(self.limits)),
            least: 1,
            most: self.most,
            wanted: self.wanted,
        }
    }
}

/// A rectangle by its least x and y and its greatest, which has an area.
#[derive(Clone, Copy, Debug)]
pub struct Rectangle(pub Limits);

impl Kind for Rectangle {
    type Of = [DVec2; 2];

    fn read(&self, cx: &Context, node: &Node, key: &str) -> Option<[DVec2; 2]> {
        let [x0, y0, x1, y1] = numbers_at(cx, node, key, self.0)?;
        if x0 < x1 && y0 < y1 {
            return Some([DVec2::new(x0, y0), DVec2::new(x1, y1)]);
        }
        let error = DocumentError::Impossible {
            key: key.to_owned(),
            problem: "the rectangle has no area".to_owned(),
            help: format!("write the least x and y first: `{key} = [-1, -1, 1, 1]`"),
        };
        cx.error(&node.at, error);
        None
    }

    fn write(&self, &[least, most]: &[DVec2; 2]) -> Value {
        list([least.x, least.y, most.x, most.y].map(number))
    }

    fn describe(&self) -> Type {
        Numbers::<4>(self.0).describe()
    }
}
