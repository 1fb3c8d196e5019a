//! `GraphML`: ours, and what networkx and others write.

use std::collections::BTreeMap;

use roxmltree::{Document, Node, ParsingOptions};

use super::draft::Draft;
use super::error::ImportError;
use super::fields::{EdgeField, NodeField};
use super::graph::{Builder, Text};

/// Reads the first graph of a `GraphML` text.
///
/// Attributes are known by `attr.name` of their keys, or by the key's `id` where it has no name.
///
/// # Errors
///
/// [`ImportError`] if it is no XML, holds no graph, or a value cannot be read.
pub(super) fn read(text: &str) -> Result<Draft, ImportError> {
    let options = ParsingOptions {
        nodes_limit: u32::MAX,
        ..ParsingOptions::default()
    };
    let malformed = |problem: String| ImportError::Malformed {
        format: "GraphML",
        problem,
    };
    let document = Document::parse_with_options(text, options)
        .map_err(|error| malformed(error.to_string()))?;
    let root = document.root_element();
    if root.tag_name().name() != "graphml" {
        let found = root.tag_name().name();
        return Err(malformed(format!("its outermost element is <{found}>")));
    }
    let keys: BTreeMap<&str, &str> = root
        .children()
        .filter(|node| node.has_tag_name_of("key"))
        .filter_map(|key| {
            let id = key.attribute("id")?;
            Some((id, key.attribute("attr.name").unwrap_or(id)))
        })
        .collect();
    let name_of = |key: &str| keys.get(key).copied().unwrap_or_default().to_owned();
    let graph = root.children().find(|node| node.has_tag_name_of("graph"));
    let graph = graph.ok_or_else(|| malformed("it has no <graph>".to_owned()))?;
    let line = |node: Node<'_, '_>| {
        let row = document.text_pos_at(node.range().start).row;
        format!("line {row}")
    };
    let mut builder = Builder::new(graph.attribute("edgedefault") == Some("directed"));
    // What keys stand for is looked up once.
    let mut node_fields: BTreeMap<&str, Option<NodeField>> = BTreeMap::new();
    let mut edge_fields: BTreeMap<&str, Option<EdgeField>> = BTreeMap::new();
    for node in graph.children().filter(|node| node.has_tag_name_of("node")) {
        let place = || line(node);
        let id = node.attribute("id").ok_or_else(|| ImportError::Missing {
            place: place(),
            wanted: "a node has no id".to_owned(),
        })?;
        builder.node();
        builder.name(id.to_owned());
        for (key, value) in data(node) {
            let field = *node_fields
                .entry(key)
                .or_insert_with(|| NodeField::of(&name_of(key)));
            // The id is the name.
            if let Some(field) = field.filter(|field| *field != NodeField::Name) {
                builder.node_text(
                    field,
                    &Text {
                        value,
                        key: || name_of(key),
                        place,
                    },
                )?;
            }
        }
        builder.node_is_done(place)?;
    }
    builder.nodes_are_done(line(graph))?;
    for edge in graph.children().filter(|node| node.has_tag_name_of("edge")) {
        let place = || line(edge);
        builder.edge();
        for (end, key) in [(0, "source"), (1, "target")] {
            let value = edge.attribute(key).unwrap_or_default();
            let text = Text {
                value,
                key: || key.to_owned(),
                place,
            };
            builder.edge_text(EdgeField::End(end), &text)?;
        }
        for (key, value) in data(edge) {
            let field = *edge_fields
                .entry(key)
                .or_insert_with(|| EdgeField::of(&name_of(key)));
            match field {
                None | Some(EdgeField::End(_) | EdgeField::EndCoordinate(..)) => {}
                Some(field) => {
                    builder.edge_text(
                        field,
                        &Text {
                            value,
                            key: || name_of(key),
                            place,
                        },
                    )?;
                }
            }
        }
        builder.edge_is_done(place);
    }
    for (key, value) in data(graph) {
        if name_of(key) == "segment_mm" {
            builder.draft.segment_mm = value.trim().parse().ok();
        }
    }
    Ok(builder.draft)
}

/// Key and text of each `<data>` of an element.
fn data<'d>(node: Node<'d, '_>) -> impl Iterator<Item = (&'d str, &'d str)> {
    node.children()
        .filter(|child| child.has_tag_name_of("data"))
        .filter_map(|child| Some((child.attribute("key")?, child.text().unwrap_or_default())))
}

/// Names of elements without their namespace, which some programs leave out.
trait TagName {
    fn has_tag_name_of(&self, name: &str) -> bool;
}

impl TagName for Node<'_, '_> {
    fn has_tag_name_of(&self, name: &str) -> bool {
        self.is_element() && self.tag_name().name() == name
    }
}
