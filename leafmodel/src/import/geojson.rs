//! `GeoJSON`: ours, and lines with a width or radius of other programs.

use glam::DVec2;
use serde_json::Value;

use super::draft::{ABSENT, Draft, DraftEdge, DraftMargin};
use super::error::ImportError;
use super::fields::{EdgeField, Unit};
use super::graph::{Builder, Text, shortened};

/// Reads the features of a `FeatureCollection`: every `LineString` is a vein, a `Polygon` whose
/// `kind` is `margin` (or the only one of all features) the margin.
///
/// `coordinate_unit` says `mm`, `um` or `m`; without it coordinates are in the file's own units.
///
/// # Errors
///
/// [`ImportError`] if there is no line, or a value cannot be read.
pub(super) fn read_value(file: &Value) -> Result<Draft, ImportError> {
    let wanted = "a GeoJSON FeatureCollection with LineStrings";
    let features = file["features"].as_array();
    let features = features.ok_or(ImportError::NoVeins(wanted))?;
    let unit = match file["coordinate_unit"].as_str() {
        None => Unit::OfTheFile,
        Some("mm") => Unit::Millimetres(1.0),
        Some("um" | "µm") => Unit::Millimetres(1e-3),
        Some("m") => Unit::Millimetres(1e3),
        Some(other) => {
            let (key, other) = ("coordinate_unit", shortened(other));
            let allowed = "it is mm, um or m";
            return Err(ImportError::bad_value(
                "the collection",
                key,
                &other,
                allowed,
            ));
        }
    };
    let mut lines = Lines {
        builder: Builder::new(false),
        unit,
        numbered: Vec::new(),
    };
    let mut polygons = Vec::new();
    for (number, feature) in features.iter().enumerate() {
        let geometry = &feature["geometry"];
        let coordinates = &geometry["coordinates"];
        match geometry["type"].as_str() {
            Some("LineString") => lines.add(number, coordinates, &feature["properties"])?,
            Some("MultiLineString") => {
                for line in coordinates.as_array().into_iter().flatten() {
                    lines.add(number, line, &feature["properties"])?;
                }
            }
            Some("Polygon") => polygons.push((number, feature)),
            Some(other) => lines
                .builder
                .ignore("file", &format!("features[{number}]: {other}")),
            None => lines.builder.ignore("file", &format!("features[{number}]")),
        }
    }
    let of_kind = |kind: &str| {
        let these = polygons.iter().copied();
        let these = these.filter(|(_, feature)| feature["properties"]["kind"] == kind);
        these.collect::<Vec<_>>()
    };
    let mut margins = of_kind("margin");
    if margins.is_empty() && polygons.len() == 1 {
        margins.clone_from(&polygons);
    }
    for (number, feature) in &polygons {
        // Areoles are measured from the veins.
        let is_areole = feature["properties"]["kind"] == "areole";
        if !is_areole && !margins.iter().any(|(margin, _)| margin == number) {
            let name = format!("features[{number}]: Polygon");
            lines.builder.ignore("file", &name);
        }
    }
    for (number, feature) in margins {
        let rings = &feature["geometry"]["coordinates"];
        let holes = rings.as_array().map_or(0, Vec::len).saturating_sub(1);
        if holes > 0 {
            let name = format!("features[{number}]: holes of the margin: {holes}");
            lines.builder.ignore("file", &name);
        }
        let ring = rings.get(0);
        let ring = ring.unwrap_or(&Value::Null);
        let points = lines.places(number, ring)?;
        let ends = |key: &str| {
            let pair = feature["properties"].get(key)?;
            Some(DVec2::new(pair.get(0)?.as_f64()?, pair.get(1)?.as_f64()?))
        };
        let (base, apex) = (ends("base_mm"), ends("apex_mm"));
        lines
            .builder
            .draft
            .margins
            .push(DraftMargin { points, base, apex });
    }
    let mut draft = lines.whole()?;
    draft.segment_mm = file["segment_mm"].as_f64();
    Ok(draft)
}

/// The number of an edge, the edge, and numbers and places of its nodes.
type Numbered = (u32, DraftEdge, [(u32, DVec2); 2]);

/// Lines that are being read.
struct Lines {
    builder: Builder,
    unit: Unit,
    /// The numbers that nodes and edges had in the network from which the file was written.
    numbered: Vec<Numbered>,
}

impl Lines {
    fn places(&mut self, feature: usize, list: &Value) -> Result<Vec<DVec2>, ImportError> {
        let bad = |value: &Value| {
            let (place, value) = (
                format!("features[{feature}]"),
                shortened(&value.to_string()),
            );
            let allowed = "it must be a list of positions, each a list of two numbers or more";
            ImportError::bad_value(place, "coordinates", &value, allowed)
        };
        let positions = list.as_array().ok_or_else(|| bad(list))?;
        let mut places = Vec::with_capacity(positions.len());
        for position in positions {
            let axis = |axis: usize| position.get(axis).and_then(Value::as_f64);
            let pair = [axis(0), axis(1)];
            let [Some(x), Some(y)] = pair else {
                return Err(bad(position));
            };
            let place = [x, y].map(|value| self.builder.draft.place_in(value, self.unit));
            places.push(DVec2::from(place));
        }
        Ok(places)
    }

    /// Adds a line with its properties.
    fn add(&mut self, feature: usize, line: &Value, properties: &Value) -> Result<(), ImportError> {
        let places = self.places(feature, line)?;
        if places.len() < 2 {
            let name = format!("features[{feature}]: a line of {} points", places.len());
            self.builder.ignore("file", &name);
            return Ok(());
        }
        if let Some(numbers) = Numbers::of(properties, places.len()) {
            self.builder.draft.is_directed = true;
            for step in 0..places.len() - 1 {
                let ends = [numbers.nodes[step], numbers.nodes[step + 1]];
                let edge = DraftEdge {
                    ends,
                    radii: [numbers.radii[2 * step], numbers.radii[2 * step + 1]].map(Some),
                    order: numbers.order,
                };
                let nodes = [(ends[0], places[step]), (ends[1], places[step + 1])];
                self.numbered.push((numbers.edges[step], edge, nodes));
            }
            return Ok(());
        }
        let place = &|| format!("features[{feature}]");
        for pair in places.windows(2) {
            let ends = [pair[0], pair[1]].map(|place| self.builder.node_at(place));
            self.builder.edge_between(ends);
            for (key, value) in properties.as_object().into_iter().flatten() {
                let field = match EdgeField::of(key) {
                    // What has no unit of its own has that of the coordinates.
                    Some(EdgeField::Radius(Unit::OfTheFile)) => EdgeField::Radius(self.unit),
                    Some(EdgeField::Width(Unit::OfTheFile)) => EdgeField::Width(self.unit),
                    Some(EdgeField::EndRadius(end, Unit::OfTheFile)) => {
                        EdgeField::EndRadius(end, self.unit)
                    }
                    // The line itself has its course and its length.
                    Some(
                        EdgeField::End(_)
                        | EdgeField::EndCoordinate(..)
                        | EdgeField::Length(_)
                        | EdgeField::Weight
                        | EdgeField::Course(_)
                        | EdgeField::CourseInRows(_)
                        | EdgeField::Nothing,
                    ) => continue,
                    None => {
                        // The kind of feature.
                        if key != "kind" {
                            self.builder.ignore("edge", key);
                        }
                        continue;
                    }
                    Some(field) => field,
                };
                if value.is_null() {
                    continue;
                }
                let value = &text_of(value);
                self.builder.edge_text(field, Text { key, value, place })?;
            }
            self.builder.edge_is_done(place);
        }
        Ok(())
    }

    /// The whole: numbered nodes and edges in their old order, if all lines have numbers.
    fn whole(mut self) -> Result<Draft, ImportError> {
        if self.numbered.is_empty() {
            return Ok(self.builder.done());
        }
        let missing = |problem: &str| ImportError::at("nodes", problem);
        if !self.builder.draft.edges.is_empty() {
            return Err(missing("some lines number their nodes and some do not"));
        }
        self.numbered.sort_by_key(|(number, ..)| *number);
        let most = self
            .numbered
            .iter()
            .flat_map(|(.., nodes)| nodes.map(|node| node.0))
            .max();
        let count = most.map_or(0, |most| most as usize + 1);
        if count > 2 * self.numbered.len() {
            return Err(missing(
                "their numbers are larger than there are ends of edges",
            ));
        }
        let unseen = DVec2::splat(f64::MAX);
        let mut places = vec![unseen; count];
        for (.., nodes) in &self.numbered {
            for &(node, place) in nodes {
                let at = &mut places[node as usize];
                if *at != unseen && *at != place {
                    return Err(missing(&format!("node {node} has two places")));
                }
                *at = place;
            }
        }
        if places.contains(&unseen) {
            // Numbers without a place are closed up.
            let mut next = 0;
            let new: Vec<u32> = places
                .iter()
                .map(|place| {
                    let number = if *place == unseen { ABSENT } else { next };
                    next += u32::from(*place != unseen);
                    number
                })
                .collect();
            for (_, edge, _) in &mut self.numbered {
                edge.ends = edge.ends.map(|end| new[end as usize]);
            }
            places.retain(|place| *place != unseen);
        }
        self.builder.draft.places = places;
        self.builder.draft.edges = self.numbered.into_iter().map(|(_, edge, _)| edge).collect();
        Ok(self.builder.done())
    }
}

/// What our own files tell beside the line.
struct Numbers {
    nodes: Vec<u32>,
    edges: Vec<u32>,
    radii: Vec<f64>,
    order: Option<u8>,
}

impl Numbers {
    /// `None` if a list is missing or of another length than the line asks for.
    fn of(properties: &Value, corners: usize) -> Option<Self> {
        let whole = |key: &str, length: usize| -> Option<Vec<u32>> {
            let list = properties
                .get(key)?
                .as_array()
                .filter(|l| l.len() == length)?;
            let number = |value: &Value| value.as_u64().and_then(|n| u32::try_from(n).ok());
            list.iter().map(number).collect()
        };
        let steps = corners.checked_sub(1).filter(|steps| *steps > 0)?;
        let radii = properties.get("radii_mm")?.as_array();
        let radii = radii.filter(|list| list.len() == 2 * steps)?;
        let order = properties.get("order").and_then(Value::as_u64);
        Some(Self {
            nodes: whole("nodes", corners)?,
            edges: whole("edges", steps)?,
            radii: radii.iter().map(Value::as_f64).collect::<Option<_>>()?,
            order: order
                .and_then(|order| u8::try_from(order).ok())
                .filter(|o| *o > 0),
        })
    }
}

/// A value as text; nothing for `null`.
pub(super) fn text_of(value: &Value) -> String {
    if value.is_null() {
        return String::new();
    }
    value
        .as_str()
        .map_or_else(|| value.to_string(), str::to_owned)
}
