//! Lists of blocks, and blocks with names of the user's choice.

use super::{Keys, Pass, fresh};
use crate::inheritance;
use crate::names::require_name;
use crate::reader::Block;
use crate::schema::{BlockSchema, Is};
use crate::tree::{Node, Value};
use crate::values::{wrong_length, wrong_type};
use crate::written::Written;

/// The list that [`Keys::blocks`] reads.
pub struct BlockList<'w, T> {
    /// How many there are at most.
    pub most: usize,
    /// One with all defaults.
    pub new: &'w dyn Fn() -> T,
    /// What messages call the list.
    pub wanted: &'w str,
    /// Whether the list is part of a list of the same kind, whose description holds.
    pub is_inside_itself: bool,
}

/// The blocks that [`Keys::named`] reads.
pub struct NamedList<'n, T> {
    /// Whether there must be one at least, unless a preset stands beneath.
    pub required: bool,
    /// One with all defaults under a name.
    pub new: &'n dyn Fn(&str) -> T,
    /// The name of one.
    pub name_of: fn(&T) -> &str,
}

impl Keys<'_> {
    /// A list of tables; those of a file take the place of all that were there.
    pub fn blocks<T>(
        &mut self,
        name: &'static str,
        value: &mut Vec<T>,
        list: &BlockList<'_, T>,
        about: &'static str,
        declare: impl Fn(&mut T, &mut Keys<'_>),
    ) {
        match &mut self.pass {
            Pass::Read(reading) => {
                let block = &reading.block;
                let Some(node) = block.node(name) else {
                    return;
                };
                let Value::List(nodes) = &node.value else {
                    wrong_type(block.cx, node, name, list.wanted);
                    return;
                };
                if nodes.len() > list.most {
                    wrong_length(block.cx, &node.at, name, "a list", nodes.len(), list.wanted);
                    return;
                }
                value.clear();
                for (number, node) in nodes.iter().enumerate() {
                    let Some(table) = node.table() else {
                        wrong_type(block.cx, node, name, list.wanted);
                        continue;
                    };
                    let path = format!("{}[{number}]", block.path_of(name));
                    let inner = Block::new(block.cx, table, path, node.at.clone());
                    let mut read = (list.new)();
                    Self::read_within(inner, None, |keys| declare(&mut read, keys));
                    value.push(read);
                }
            }
            Pass::Write { extent, block } => {
                if !value.is_empty() {
                    let tables = value.iter_mut().map(|one| {
                        let own = fresh(*extent, one, &mut (list.new)(), &declare);
                        Node::unplaced(Value::Table(own.into_table()))
                    });
                    block.value(name, true, Value::List(tables.collect()));
                }
            }
            Pass::Check(ranges) => {
                ranges.length(name, value.len(), 0, list.most, list.wanted);
                for (number, one) in value.iter_mut().enumerate() {
                    Self::check_inside(ranges, &format!("{name}[{number}]"), |keys| {
                        declare(one, keys);
                    });
                }
            }
            Pass::Describe(schema) => {
                let of = list.is_inside_itself.then_some(BlockSchema::default());
                let of =
                    of.unwrap_or_else(|| Self::describe(|keys| declare(&mut (list.new)(), keys)));
                schema.entry(
                    name,
                    about,
                    false,
                    Is::List {
                        of,
                        most: list.most,
                        again: list.is_inside_itself,
                    },
                );
            }
        }
    }

    /// A block of blocks with names of the user's choice. Those of a file come behind the preset's;
    /// one with a name that the preset has changes that one.
    pub fn named<T>(
        &mut self,
        name: &'static str,
        value: &mut Vec<T>,
        list: &NamedList<'_, T>,
        about: &'static str,
        declare: impl Fn(&mut T, &mut Keys<'_>),
    ) {
        match &mut self.pass {
            Pass::Read(reading) => {
                let block = &reading.block;
                let demanded = list.required && reading.base.is_none();
                if block.entry(name).is_none() && !demanded {
                    return;
                }
                let section = if demanded {
                    block.block(name, &[])
                } else {
                    block.optional_block(name)
                };
                let Some(section) = section else {
                    return;
                };
                let of_preset = value.len();
                for entry in &section.table.0 {
                    require_name(section.cx, &entry.key, &entry.key_at);
                    let Some(inner) = section.open(entry) else {
                        continue;
                    };
                    let known = value[..of_preset]
                        .iter()
                        .position(|one| (list.name_of)(one) == entry.key);
                    let base = reading.base.clone().filter(|_| known.is_some());
                    let index = known.unwrap_or_else(|| {
                        value.push((list.new)(&entry.key));
                        value.len() - 1
                    });
                    Self::read_within(inner, base, |keys| declare(&mut value[index], keys));
                }
            }
            Pass::Write { extent, block } => {
                if !value.is_empty() {
                    let mut all = Written::default();
                    for one in value {
                        let name = (list.name_of)(one).to_owned();
                        let own = fresh(*extent, one, &mut (list.new)(&name), &declare);
                        all.block(&name, true, own);
                    }
                    block.block(name, true, all);
                }
            }
            Pass::Check(ranges) => {
                for one in value {
                    let path = format!("{name}.{}", (list.name_of)(one));
                    Self::check_inside(ranges, &path, |keys| declare(one, keys));
                }
            }
            Pass::Describe(schema) => schema.entry(
                name,
                about,
                list.required,
                Is::Named(Self::describe(|keys| {
                    if inheritance::SECTIONS.contains(&name) {
                        inheritance::describe(keys);
                    }
                    declare(&mut (list.new)("NAME"), keys);
                })),
            ),
        }
    }
}
