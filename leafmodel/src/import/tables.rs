//! Tables of edges and of nodes: CSV with commas, semicolons or tabs.
//!
//! A table of edges has a row for each piece of vein. Either the row tells where its ends are
//! (`from_x_mm`, `from_y_mm`, `to_x_mm`, `to_y_mm`), or it names them (`from`, `to`) and a table of
//! nodes has the places (`id`, `x_mm`, `y_mm`). Lines that begin with `#` are left out.

use csv::StringRecord;

use super::draft::Draft;
use super::error::ImportError;
use super::faults::{Fault, FaultKind};
use super::fields::{EdgeField, NodeField};
use super::graph::{Builder, Text};
use super::is_blank;
use crate::document::rows::{Field, Form, Ragged, Row, Rows};

/// Reads a table of edges, and one of nodes if there is one.
///
/// # Errors
///
/// [`ImportError`] if columns are missing or a value cannot be read; its places are lines, of the
/// table of edges if nothing else is said.
pub(super) fn read(edges: &str, nodes: Option<&str>, form: Form) -> Result<Draft, ImportError> {
    // A row leads from its `from` to its `to`; whether that is away from the petiole is found later.
    let mut builder = Builder::new(true);
    let mut guesses = Fault::new(FaultKind::Guess);
    if let Some(nodes) = nodes {
        read_nodes(nodes, form, &mut builder, &mut guesses)?;
    }
    let mut table = Table::open(edges, form, "a table of edges", &|name| {
        EdgeField::of(name).is_some() || NodeField::of(name).is_some()
    })?;
    if nodes.is_none() && is_of_nodes(&table.header) {
        return Err(
            table.refused("this is a table of nodes: give it by --nodes beside a table of edges")
        );
    }
    let is_of_skan = table.header.iter().any(|name| is_skans(name));
    let fields = edge_fields(&table.header);
    ignore_unknown(&mut builder, "edge", &table.header, |name| {
        EdgeField::of(name).is_some()
    });
    let column = |wanted: &dyn Fn(EdgeField) -> bool| {
        fields.iter().position(|field| field.is_some_and(wanted))
    };
    let names = [0, 1].map(|end| column(&|field| field == EdgeField::End(end)));
    let names_places = (0..4).all(|i| {
        column(&|field| matches!(field, EdgeField::EndCoordinate(end, axis, _) if (end, axis) == (i / 2, i % 2)))
            .is_some()
    });
    if nodes.is_none() && !names_places {
        return Err(table.refused(
            "a table of edges has the columns from_x_mm, from_y_mm, to_x_mm, to_y_mm, or a table of \
             nodes beside it (--nodes FILE.csv) and the columns from and to",
        ));
    }
    if nodes.is_some() && names.contains(&None) {
        let problem = "a table of edges beside one of nodes has the columns from and to";
        return Err(table.refused(problem));
    }
    while let Some((row, line)) = table.next()? {
        let place = &|| format!("line {line}");
        builder.edge();
        for ((field, value), name) in fields.iter().zip(&row).zip(&table.header) {
            let Some(field) = *field else { continue };
            let is_place = matches!(field, EdgeField::EndCoordinate(..));
            let is_name = matches!(field, EdgeField::End(_));
            if (is_place && nodes.is_some()) || (is_name && nodes.is_none()) {
                continue;
            }
            let is_course = matches!(field, EdgeField::Course(_) | EdgeField::CourseInRows(_));
            let value = if is_course {
                value.into()
            } else {
                table.number_text(value)
            };
            let (key, value) = (name, &value);
            builder.edge_text(field, Text { key, value, place })?;
        }
        if nodes.is_some() {
            builder.edge_is_done(place);
        } else {
            let both = names.map(|column| column.and_then(|column| row.get(column)));
            let both = if both.contains(&None) {
                [None; 2]
            } else {
                both
            };
            builder.edge_with_places_is_done(both, place)?;
        }
    }
    table.add_guesses(&mut guesses, "edges");
    let mut draft = builder.done();
    draft.remarks.extend((guesses.count > 0).then_some(guesses));
    draft.is_y_down |= is_of_skan;
    draft.segment_mm = edges
        .lines()
        .take_while(|line| line.starts_with('#'))
        .find_map(segment);
    if nodes.is_none() {
        in_order_of_numbers(&mut draft);
    }
    Ok(draft)
}

/// Whether a column is a row or a column of a skeleton of skan.
fn is_skans(name: &str) -> bool {
    ["coord", "image-coord", "image_coord"]
        .iter()
        .any(|start| name.starts_with(start))
}

/// What the columns of a table of edges hold. Skeletons of skan have places in pixels beside those
/// in the unit of their lengths; these count.
fn edge_fields(header: &[String]) -> Vec<Option<EdgeField>> {
    let has_places = header.iter().any(|name| name.starts_with("coord"));
    let fields = header.iter().map(|name| {
        let is_pixel = has_places && name.starts_with("image");
        EdgeField::of(name).filter(|_| !is_pixel)
    });
    fields.collect()
}

/// Remembers the columns that are not read.
fn ignore_unknown(
    builder: &mut Builder,
    of: &str,
    header: &[String],
    is_known: impl Fn(&str) -> bool,
) {
    for name in header.iter().filter(|name| !is_known(name)) {
        builder.ignore(of, name);
    }
}

/// The length of a segment out of a line `# segment_mm = 0.12`.
fn segment(comment: &str) -> Option<f64> {
    let (_, value) = comment.split_once("segment_mm =")?;
    value.trim().parse().ok()
}

/// Nodes that are called by numbers are put in the order of those; they were found in that of edges.
fn in_order_of_numbers(draft: &mut Draft) {
    let numbers: Option<Vec<u32>> = draft.names.iter().map(|name| name.parse().ok()).collect();
    let Some(numbers) = numbers.filter(|numbers| !numbers.is_empty()) else {
        return;
    };
    let mut order: Vec<u32> = (0..numbers.len() as u32).collect();
    order.sort_by_key(|&node| numbers[node as usize]);
    let mut rank = vec![0; order.len()];
    for (new, &old) in (0..).zip(&order) {
        rank[old as usize] = new;
    }
    draft.places = order
        .iter()
        .map(|&old| draft.places[old as usize])
        .collect();
    draft.names = order
        .iter()
        .map(|&old| draft.names[old as usize].clone())
        .collect();
    for edge in &mut draft.edges {
        edge.ends = edge.ends.map(|end| rank[end as usize]);
    }
}

/// Whether columns are those of nodes: places, and nothing that an edge has alone.
fn is_of_nodes(header: &[String]) -> bool {
    let has_places = header
        .iter()
        .any(|name| matches!(NodeField::of(name), Some(NodeField::Coordinate(..))));
    let is_of_edges =
        |name: &String| !matches!(EdgeField::of(name), None | Some(EdgeField::Nothing));
    has_places && !header.iter().any(is_of_edges)
}

fn read_nodes(
    text: &str,
    form: Form,
    builder: &mut Builder,
    guesses: &mut Fault,
) -> Result<(), ImportError> {
    let of_nodes = |error| match error {
        ImportError::At { place, problem } => {
            ImportError::at(format!("table of nodes, {place}"), problem)
        }
        other @ (ImportError::Empty
        | ImportError::Malformed { .. }
        | ImportError::NoVeins(_)
        | ImportError::NoScale(_)
        | ImportError::MixedUnits(_)
        | ImportError::Faulty(_)
        | ImportError::BadMargin(_)) => other,
    };
    let mut read = || -> Result<(), ImportError> {
        if is_blank(text) {
            return Err(ImportError::at("the file", "it is empty"));
        }
        let mut table = Table::open(text, form, "a table of nodes", &|name| {
            NodeField::of(name).is_some()
        })?;
        let mut fields: Vec<Option<NodeField>> = table
            .header
            .iter()
            .map(|name| NodeField::of(name))
            .collect();
        ignore_unknown(builder, "node", &table.header, |name| {
            NodeField::of(name).is_some()
        });
        // Of several columns that may name a node, the first does.
        let mut is_named = false;
        for field in &mut fields {
            if *field == Some(NodeField::Name) && std::mem::replace(&mut is_named, true) {
                *field = None;
            }
        }
        while let Some((row, line)) = table.next()? {
            let place = &|| format!("line {line}");
            builder.node();
            for ((field, value), name) in fields.iter().zip(&row).zip(&table.header) {
                let Some(field) = *field else { continue };
                let (key, value) = (name, &table.number_text(value));
                builder.node_text(field, Text { key, value, place })?;
            }
            builder.node_is_done(place)?;
        }
        table.add_guesses(guesses, "nodes");
        builder.nodes_are_done("its names".to_owned())
    };
    read().map_err(of_nodes)
}

fn listed(names: &[String]) -> String {
    const MOST: usize = 20;
    let mut shown = names[..names.len().min(MOST)].join(", ");
    if names.len() > MOST {
        shown += &format!(" and {} more", names.len() - MOST);
    }
    shown
}

/// A table that is being read.
struct Table<'t> {
    /// Names of columns, safe to print.
    header: Vec<String>,
    rows: Rows<'t>,
    below: std::vec::IntoIter<Result<Row, Ragged>>,
}

impl<'t> Table<'t> {
    fn open(
        text: &'t str,
        form: Form,
        what: &'static str,
        is_known: &dyn Fn(&str) -> bool,
    ) -> Result<Self, ImportError> {
        let rows = Rows::written(text, form);
        let mut below = rows.records().collect::<Vec<_>>().into_iter();
        let names = below
            .next()
            .transpose()
            .map_err(|ragged| malformed(&ragged))?;
        let names = names.map_or_else(Vec::new, |row| row.fields);
        let header: Vec<String> = names.iter().map(Field::shown).collect();
        let table = Self {
            header,
            rows,
            below,
        };
        if table.header.iter().any(|name| is_known(name)) {
            Ok(table)
        } else {
            Err(table.refused(&format!("{what} begins with the names of its columns")))
        }
    }

    /// What is wrong with the columns, with those that there are.
    fn refused(&self, problem: &str) -> ImportError {
        let columns = listed(&self.header);
        ImportError::at("line 1", format!("{problem}; here are: {columns}"))
    }

    /// The next row and its line.
    fn next(&mut self) -> Result<Option<(StringRecord, u64)>, ImportError> {
        let row = self.below.next().transpose();
        let row = row.map_err(|ragged| malformed(&ragged))?;
        Ok(row.map(|row| {
            let texts = row.fields.into_iter().map(|field| field.text);
            (texts.collect(), row.line as u64)
        }))
    }

    /// Notes what was found from the table instead of being known.
    fn add_guesses(&self, guesses: &mut Fault, of: &str) {
        for guess in self.rows.guesses() {
            guesses.named(|| format!("{of}: {guess}"));
        }
    }

    fn number_text<'v>(&self, value: &'v str) -> std::borrow::Cow<'v, str> {
        if value.contains(',') && self.rows.is_number(value) {
            value.replace(',', ".").into()
        } else {
            value.into()
        }
    }
}

fn malformed(ragged: &Ragged) -> ImportError {
    ImportError::malformed("table", format!("line {}: {ragged}", ragged.line))
}
