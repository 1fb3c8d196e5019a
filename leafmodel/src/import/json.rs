//! JSON: ours, and the node-link lists of networkx and d3.

use glam::DVec2;
use serde_json::{Map, Value, json};

use super::draft::{ABSENT, Draft, DraftEdge, DraftMargin};
use super::error::ImportError;
use super::faults::{Fault, FaultKind};
use super::fields::{ALLOWED_ORDERS, EdgeField};
use super::geojson::{self, text_of};
use super::graph::{Builder, Place, Text, shortened};

/// Reads a network in JSON: `nodes` and `edges` as columns, as [`crate::export::json`] writes them;
/// `nodes` and `links` (or `edges`) as lists of objects; or `GeoJSON`.
///
/// # Errors
///
/// [`ImportError`] if it is no JSON, holds no network, or a value cannot be read.
pub(super) fn read(text: &str) -> Result<Draft, ImportError> {
    let value = as_map(parsed(text)?);
    let Value::Object(file) = &value else {
        return Err(ImportError::NoVeins(WANTED));
    };
    if file
        .get("type")
        .is_some_and(|kind| kind == "FeatureCollection")
    {
        return geojson::read_value(&value);
    }
    let mut draft = match (file.get("nodes"), file.get("edges").or(file.get("links"))) {
        (Some(Value::Object(nodes)), Some(Value::Object(edges))) => columns(file, nodes, edges)?,
        (Some(Value::Array(nodes)), Some(Value::Array(edges))) => lists(file, nodes, edges)?,
        _ => return Err(ImportError::NoVeins(WANTED)),
    };
    if file.contains_key("edges") && file.contains_key("links") {
        let mut links = Fault::new(FaultKind::Ignored);
        links.named(|| "\"links\" beside \"edges\"".to_owned());
        draft.remarks.push(links);
    }
    Ok(draft)
}

const WANTED: &str = "an object with nodes and edges (as lamina grow writes it), with nodes and links (as networkx \
     does), or a GeoJSON FeatureCollection";

/// Reads the margin alone, which may stand without a network.
///
/// # Errors
///
/// As for [`read`].
pub(super) fn read_margin(text: &str) -> Result<Draft, ImportError> {
    let value = as_map(parsed(text)?);
    let is_map = value["type"] == "FeatureCollection";
    if is_map {
        return geojson::read_value(&value);
    }
    let mut draft = Draft::default();
    if let Some(file) = value.as_object() {
        add_margins(file, &mut draft)?;
    }
    Ok(draft)
}

fn parsed(text: &str) -> Result<Value, ImportError> {
    serde_json::from_str(text).map_err(|error| ImportError::malformed("JSON", error.to_string()))
}

/// A `GeoJSON` that is a single feature or geometry as a collection with it; others as they are.
fn as_map(value: Value) -> Value {
    let feature = match value["type"].as_str() {
        Some("Feature") => value,
        Some("LineString" | "MultiLineString" | "Polygon") => {
            json!({"type": "Feature", "properties": {}, "geometry": value})
        }
        Some(_) | None => return value,
    };
    json!({"type": "FeatureCollection", "features": [feature]})
}

fn add_margins(file: &Map<String, Value>, draft: &mut Draft) -> Result<(), ImportError> {
    if let Some(outline) = file.get("outline") {
        draft.margins.push(margin(outline)?);
    }
    for outline in file
        .get("outlines")
        .and_then(Value::as_array)
        .into_iter()
        .flatten()
    {
        draft.margins.push(margin(outline)?);
    }
    Ok(())
}

/// Columns of equal length.
fn columns(
    file: &Map<String, Value>,
    nodes: &Map<String, Value>,
    edges: &Map<String, Value>,
) -> Result<Draft, ImportError> {
    let (x, y) = (
        column(nodes, "nodes", "x_mm")?,
        column(nodes, "nodes", "y_mm")?,
    );
    equal(("x_mm", x.len()), ("y_mm", y.len()))?;
    let mut draft = Draft {
        places: x
            .into_iter()
            .zip(y)
            .map(|(x, y)| DVec2::new(x, y))
            .collect(),
        is_directed: true,
        segment_mm: file.get("segment_mm").and_then(Value::as_f64),
        ..Draft::default()
    };
    if nodes.contains_key("born_step") {
        let born = column(nodes, "nodes", "born_step")?;
        equal(("x_mm", draft.places.len()), ("born_step", born.len()))?;
        draft.born = born.into_iter().map(|step| step as u32).collect();
    }
    let (from, to) = (
        column(edges, "edges", "from")?,
        column(edges, "edges", "to")?,
    );
    equal(("from", from.len()), ("to", to.len()))?;
    let optional = |key| {
        let there = edges.contains_key(key);
        let list = there.then(|| column(edges, "edges", key)).transpose()?;
        if let Some(list) = &list {
            equal(("from", from.len()), (key, list.len()))?;
        }
        Ok(list)
    };
    let both = optional("radius_mm")?;
    let starts = optional("radius_from_mm")?.or_else(|| both.clone());
    let ends = optional("radius_to_mm")?.or(both);
    let orders = optional("order")?;
    let count = draft.places.len() as f64;
    for (edge, (from, to)) in from.iter().zip(&to).enumerate() {
        let mut node = |number: f64| {
            if number.fract() == 0.0 && (0.0..count).contains(&number) {
                return number as u32;
            }
            draft
                .loose
                .push((format!("edge {edge}"), number.to_string()));
            ABSENT
        };
        let ends_of = [node(*from), node(*to)];
        let at = |list: &Option<Vec<f64>>| list.as_ref().map(|list| list[edge]);
        let order = at(&orders).map(|order| {
            let allowed = order.fract() == 0.0 && (1.0..=255.0).contains(&order);
            allowed.then_some(order as u8).ok_or(order)
        });
        let order = order.transpose().map_err(|order| {
            let (place, order) = (format!("edge {edge}"), order.to_string());
            ImportError::bad_value(place, "order", &order, ALLOWED_ORDERS)
        })?;
        draft.edges.push(DraftEdge {
            ends: ends_of,
            radii: [at(&starts), at(&ends)],
            order,
        });
    }
    add_margins(file, &mut draft)?;
    Ok(draft)
}

fn equal(one: (&str, usize), other: (&str, usize)) -> Result<(), ImportError> {
    if one.1 == other.1 {
        return Ok(());
    }
    let problem = format!(
        "it has {} numbers, and {} has {}: columns are of equal length",
        other.1, one.0, one.1
    );
    Err(ImportError::at(other.0, problem))
}

/// A column of numbers; `null` is NaN.
fn column(of: &Map<String, Value>, name: &str, key: &str) -> Result<Vec<f64>, ImportError> {
    let list = of.get(key).and_then(Value::as_array);
    let list = list.ok_or_else(|| ImportError::at(name, format!("it has no list {key}")))?;
    let number = |(index, value): (usize, &Value)| {
        let number = if value.is_null() {
            Some(f64::NAN)
        } else {
            value.as_f64()
        };
        number.ok_or_else(|| {
            let (place, value) = (format!("{name} {index}"), shortened(&value.to_string()));
            ImportError::bad_value(place, key, &value, "it must be a number")
        })
    };
    list.iter().enumerate().map(number).collect()
}

fn margin(outline: &Value) -> Result<DraftMargin, ImportError> {
    let pair = |value: &Value| -> Option<DVec2> {
        let pair = value.as_array().filter(|list| list.len() == 2)?;
        Some(DVec2::new(pair[0].as_f64()?, pair[1].as_f64()?))
    };
    let bad = || ImportError::bad_margin("outline.points_mm is a list of pairs of numbers");
    let points = outline["points_mm"].as_array().ok_or_else(bad)?;
    let points: Option<Vec<DVec2>> = points.iter().map(pair).collect();
    Ok(DraftMargin {
        points: points.ok_or_else(bad)?,
        base: pair(&outline["base_mm"]),
        apex: pair(&outline["apex_mm"]),
    })
}

/// Lists of objects.
fn lists(
    file: &Map<String, Value>,
    nodes: &[Value],
    edges: &[Value],
) -> Result<Draft, ImportError> {
    let is_directed = file.get("directed").and_then(Value::as_bool);
    let mut builder = Builder::new(is_directed.unwrap_or(false));
    for (number, node) in nodes.iter().enumerate() {
        let place = &|| format!("nodes[{number}]");
        builder.node();
        for (key, value) in object(node, place)? {
            let value = &text_of(value);
            // Only `id` names a node: others may have a label beside it.
            if key == "id" {
                builder.name(value.trim().to_owned());
            } else {
                builder.node_entry(Text { key, value, place })?;
            }
        }
        builder.node_is_done(place)?;
    }
    builder.nodes_are_done("nodes".to_owned())?;
    for (number, edge) in edges.iter().enumerate() {
        let place = &|| format!("edges[{number}]");
        let members = object(edge, place)?;
        builder.edge();
        for (number, end) in ["source", "target"].into_iter().enumerate() {
            let is_end = Some(EdgeField::End(number));
            if !members.keys().any(|key| builder.edge_field(key) == is_end) {
                let problem = format!("an edge needs source and target; it has no {end}");
                return Err(ImportError::at(place(), problem));
            }
        }
        for (key, value) in members {
            let value = &text_of(value);
            builder.edge_entry(Text { key, value, place })?;
        }
        builder.edge_is_done(place);
    }
    Ok(builder.done())
}

fn object<'v>(value: &'v Value, place: Place<'_>) -> Result<&'v Map<String, Value>, ImportError> {
    let object = value.as_object();
    object.ok_or_else(|| ImportError::at(place(), "it is no object"))
}
