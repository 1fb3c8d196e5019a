//! `GraphML`: ours, and what networkx and others write.

use std::collections::BTreeMap;

use roxmltree::{Document, Node, ParsingOptions};

use super::draft::Draft;
use super::error::ImportError;
use super::fields::EdgeField;
use super::graph::{Builder, Text};

/// Reads the first graph of a `GraphML` text.
///
/// Attributes are known by `attr.name` of their keys, or by the key's `id` where it has no name.
///
/// # Errors
///
/// [`ImportError`] if it is no XML, holds no graph, or a value cannot be read.
pub(super) fn read(text: &str) -> Result<Draft, ImportError> {
    let document = parsed(text)?;
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
    let (node_defaults, edge_defaults) = (defaults(root, "node"), defaults(root, "edge"));
    let name_of = |key: &str| keys.get(key).copied().unwrap_or_default();
    let graph = root.children().find(|node| node.has_tag_name_of("graph"));
    let graph = graph.ok_or_else(|| malformed("it has no <graph>".to_owned()))?;
    let line = |node: Node<'_, '_>| {
        let row = document.text_pos_at(node.range().start).row;
        format!("line {row}")
    };
    let mut builder = Builder::new(graph.attribute("edgedefault") == Some("directed"));
    for node in graph.children().filter(|node| node.has_tag_name_of("node")) {
        let place = &|| line(node);
        let id = node.attribute("id");
        let id = id.ok_or_else(|| ImportError::at(place(), "a node has no id"))?;
        builder.node();
        builder.name(id.to_owned());
        for (key, value) in with_defaults(node, &node_defaults) {
            let key = name_of(key);
            builder.node_entry(Text { key, value, place })?;
        }
        builder.node_is_done(place)?;
    }
    builder.nodes_are_done(line(graph))?;
    for edge in graph.children().filter(|node| node.has_tag_name_of("edge")) {
        let place = &|| line(edge);
        builder.edge();
        for (end, key) in [(0, "source"), (1, "target")] {
            let value = edge.attribute(key).unwrap_or_default();
            builder.edge_text(EdgeField::End(end), Text { key, value, place })?;
        }
        for (key, value) in with_defaults(edge, &edge_defaults) {
            let key = name_of(key);
            if !matches!(builder.edge_field(key), Some(EdgeField::End(_))) {
                builder.edge_entry(Text { key, value, place })?;
            }
        }
        builder.edge_is_done(place);
    }
    let segment_mm = data(graph).find(|(key, _)| name_of(key) == "segment_mm");
    builder.draft.segment_mm = segment_mm.and_then(|(_, value)| value.trim().parse().ok());
    for part in left_out(root, graph, &line) {
        builder.ignore("file", &part);
    }
    Ok(builder.done())
}

/// Edges between more than two nodes, graphs within nodes and further graphs. To find a line takes
/// long, so that the first of a kind has its line.
fn left_out(
    root: Node<'_, '_>,
    graph: Node<'_, '_>,
    line: &dyn Fn(Node<'_, '_>) -> String,
) -> Vec<String> {
    let mut parts = Vec::new();
    for name in ["hyperedge", "graph"] {
        let within = graph.descendants().skip(1);
        let mut these = within.filter(|node| node.has_tag_name_of(name));
        if let Some(first) = these.next() {
            let count = 1 + these.count();
            parts.push(format!("{count} <{name}>, the first in {}", line(first)));
        }
    }
    let graphs = root.children().filter(|node| node.has_tag_name_of("graph"));
    parts.extend(
        graphs
            .skip(1)
            .map(|other| format!("<graph> in {}", line(other))),
    );
    parts
}

fn malformed(problem: String) -> ImportError {
    ImportError::malformed("GraphML", problem)
}

fn parsed(text: &str) -> Result<Document<'_>, ImportError> {
    let options = ParsingOptions {
        nodes_limit: u32::MAX,
        ..ParsingOptions::default()
    };
    let document = Document::parse_with_options(text, options);
    document.map_err(|error| malformed(error.to_string()))
}

/// Keys and texts that hold for all elements of a kind without a value of their own.
fn defaults<'d>(root: Node<'d, '_>, kind: &str) -> Vec<(&'d str, &'d str)> {
    let keys = root.children().filter(|node| node.has_tag_name_of("key"));
    let keys = keys.filter(|key| {
        let of = key.attribute("for").unwrap_or("all");
        of == kind || of == "all"
    });
    keys.filter_map(|key| {
        let mut inner = key.children();
        let default = inner.find(|node| node.has_tag_name_of("default"))?;
        Some((key.attribute("id")?, default.text().unwrap_or_default()))
    })
    .collect()
}

/// Key and text of each `<data>` of an element, and of each default that it does not have.
fn with_defaults<'d>(
    node: Node<'d, '_>,
    defaults: &'d [(&'d str, &'d str)],
) -> impl Iterator<Item = (&'d str, &'d str)> {
    let missing = move |key: &str| data(node).all(|(own, _)| own != key);
    let defaults = defaults.iter().copied();
    data(node).chain(defaults.filter(move |(key, _)| missing(key)))
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
