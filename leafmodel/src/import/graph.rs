//! Nodes and edges put together from named values.

use std::collections::{BTreeSet, HashMap};

use glam::DVec2;

use crate::document::source::quoted;

use super::draft::{ABSENT, Draft, DraftEdge};
use super::error::ImportError;
use super::faults::{Fault, FaultKind};
use super::fields::{ALLOWED_ORDERS, EdgeField, NodeField, Unit, numbers, two_numbers};

/// Relative difference of radii below which they are one, rounded.
const SAME_RADIUS: f64 = 0.01;

/// The place of something in a file, which is only asked for if it cannot be read: to find a line
/// may take long.
pub(super) type Place<'a> = &'a dyn Fn() -> String;

/// A value as text, with its key and its place in the file.
#[derive(Clone, Copy)]
pub(super) struct Text<'a> {
    pub(super) key: &'a str,
    pub(super) value: &'a str,
    pub(super) place: Place<'a>,
}

impl Text<'_> {
    fn refused(&self, allowed: &str) -> ImportError {
        ImportError::bad_value((self.place)(), self.key, &shortened(self.value), allowed)
    }

    /// A number. NaN and infinity are numbers here, since they are listed later with all others.
    fn number(&self) -> Result<f64, ImportError> {
        let number = self.value.trim().parse();
        number.map_err(|_| self.refused("it must be a number"))
    }

    /// A radius: nothing, or a number. Half of it for widths.
    fn radius(&self, share: f64) -> Result<Option<f64>, ImportError> {
        if self.value.trim().is_empty() {
            return Ok(None);
        }
        Ok(Some(self.number()? * share))
    }
}

/// A text in quotation marks, safe to print and cut if it is long.
pub(super) fn shortened(text: &str) -> String {
    format!("\"{}\"", quoted(text))
}

/// A graph that is being read: nodes first, then edges.
pub(super) struct Builder {
    pub(super) draft: Draft,
    /// Numbers of the nodes by their names. It is only asked, never walked through.
    numbers: HashMap<String, u32>,
    is_without_name: bool,
    edge_units: [Option<Unit>; 2],
    /// The radius that a value of the edge has given for both ends.
    edge_radius: Option<f64>,
    /// Whether each end has a radius of its own.
    has_end_radius: [bool; 2],
    ends: [[f64; 2]; 2],
    by_place: HashMap<[u64; 2], u32>,
    /// Whether nodes are given by rows and columns.
    is_in_rows: bool,
    ignored: BTreeSet<String>,
    /// What keys of nodes and edges stand for, each looked up once.
    node_fields: HashMap<String, Option<NodeField>>,
    edge_fields: HashMap<String, Option<EdgeField>>,
}

impl Builder {
    pub(super) fn new(is_directed: bool) -> Self {
        Self {
            draft: Draft {
                is_directed,
                ..Draft::default()
            },
            numbers: HashMap::new(),
            is_without_name: true,
            edge_units: [None; 2],
            edge_radius: None,
            has_end_radius: [false; 2],
            ends: [[f64::NAN; 2]; 2],
            by_place: HashMap::new(),
            is_in_rows: false,
            ignored: BTreeSet::new(),
            node_fields: HashMap::new(),
            edge_fields: HashMap::new(),
        }
    }

    /// Remembers an attribute of a node or an edge that is not known.
    pub(super) fn ignore(&mut self, what: &str, name: &str) {
        self.ignored
            .insert(format!("{} of {what}s", shortened(name)));
    }

    /// The draft, with a remark on whatever was ignored.
    pub(super) fn done(mut self) -> Draft {
        let mut fault = Fault::new(FaultKind::Ignored);
        for name in std::mem::take(&mut self.ignored) {
            fault.named(|| name);
        }
        self.draft
            .remarks
            .extend((fault.count > 0).then_some(fault));
        self.draft
    }

    /// Begins a node.
    pub(super) fn node(&mut self) {
        self.draft.places.push(DVec2::splat(f64::MAX));
        self.is_without_name = true;
    }

    /// Names the node that has begun.
    pub(super) fn name(&mut self, name: String) {
        self.draft.names.push(name);
        self.is_without_name = false;
    }

    /// What a key says of the node that has begun, whose name is known.
    pub(super) fn node_entry(&mut self, text: Text<'_>) -> Result<(), ImportError> {
        match looked_up(&mut self.node_fields, text.key, NodeField::of) {
            Some(NodeField::Name) => Ok(()),
            Some(field) => self.node_text(field, text),
            None => {
                self.ignore("node", text.key);
                Ok(())
            }
        }
    }

    /// A value of the node that has begun.
    pub(super) fn node_text(
        &mut self,
        field: NodeField,
        text: Text<'_>,
    ) -> Result<(), ImportError> {
        let node = self.draft.places.len() - 1;
        match field {
            NodeField::Name => self.name(text.value.trim().to_owned()),
            NodeField::Coordinate(axis, unit) => {
                let value = self.draft.place_in(text.number()?, unit);
                self.draft.places[node][axis] = value;
            }
            NodeField::Place(unit) => {
                let pair = two_numbers(text.value)
                    .ok_or_else(|| text.refused("it must be two numbers, x and y"))?;
                self.draft.places[node] = pair.map(|value| self.draft.place_in(value, unit)).into();
            }
            NodeField::PlaceInRows(unit) => {
                let [row, column] = two_numbers(text.value)
                    .ok_or_else(|| text.refused("it must be two numbers, row and column"))?;
                let place = [column, row].map(|value| self.draft.place_in(value, unit));
                self.draft.places[node] = place.into();
                self.is_in_rows = true;
                self.draft.is_y_down = true;
            }
            NodeField::Born => {
                let allowed = "it must be a whole number of steps";
                let born = text.value.trim().parse();
                let born = born.map_err(|_| text.refused(allowed))?;
                self.draft.born.resize(node, 0);
                self.draft.born.push(born);
            }
        }
        Ok(())
    }

    /// Ends a node: it must have a place, and a name of its own if nodes are named.
    pub(super) fn node_is_done(&mut self, place: Place<'_>) -> Result<(), ImportError> {
        let node = self.draft.places.len() - 1;
        if self.draft.places[node] == DVec2::splat(f64::MAX) {
            // The name may be the place, as in (12, 30).
            let pair = self
                .draft
                .names
                .get(node)
                .and_then(|name| two_numbers(name));
            if let Some(pair) = pair {
                let pair = pair.map(|value| self.draft.place_in(value, Unit::OfTheFile));
                self.draft.places[node] = pair.into();
            }
        }
        let at = self.draft.places[node];
        for (axis, name) in [(at.x, "x"), (at.y, "y")] {
            if axis == f64::MAX {
                let node = self.draft.name(node as u32);
                let problem =
                    format!("node {node} has no {name}; a node needs x and y (x_mm, y_mm), or pos");
                return Err(ImportError::at(place(), problem));
            }
        }
        if !self.is_without_name {
            let name = self.draft.names.last().cloned().unwrap_or_default();
            if self.numbers.insert(name.clone(), node as u32).is_some() {
                let problem = format!("two nodes are called {}", quoted(&name));
                return Err(ImportError::at(place(), problem));
            }
        }
        Ok(())
    }

    /// Ends the nodes.
    pub(super) fn nodes_are_done(&mut self, place: String) -> Result<(), ImportError> {
        let (names, nodes) = (self.draft.names.len(), self.draft.places.len());
        if names != 0 && names != nodes {
            let problem = "some nodes have a name and some have none";
            return Err(ImportError::at(place, problem));
        }
        if !self.draft.born.is_empty() {
            self.draft.born.resize(nodes, 0);
        }
        Ok(())
    }

    /// Begins an edge.
    pub(super) fn edge(&mut self) {
        self.draft.edges.push(DraftEdge::between(ABSENT, ABSENT));
        self.ends = [[f64::NAN; 2]; 2];
        self.edge_units = [None; 2];
        self.edge_radius = None;
        self.has_end_radius = [false; 2];
    }

    /// Begins an edge between two nodes.
    pub(super) fn edge_between(&mut self, ends: [u32; 2]) {
        self.edge();
        if let Some(edge) = self.draft.edges.last_mut() {
            edge.ends = ends;
        }
    }

    /// What a key of edges stands for.
    pub(super) fn edge_field(&mut self, key: &str) -> Option<EdgeField> {
        looked_up(&mut self.edge_fields, key, EdgeField::of)
    }

    /// What a key says of the edge that has begun, whose nodes have places.
    pub(super) fn edge_entry(&mut self, text: Text<'_>) -> Result<(), ImportError> {
        match self.edge_field(text.key) {
            Some(EdgeField::EndCoordinate(..)) => Ok(()),
            Some(field) => self.edge_text(field, text),
            None => {
                self.ignore("edge", text.key);
                Ok(())
            }
        }
    }

    /// A value of the edge that has begun.
    pub(super) fn edge_text(
        &mut self,
        field: EdgeField,
        text: Text<'_>,
    ) -> Result<(), ImportError> {
        let edge = self.draft.edges.len() - 1;
        match field {
            EdgeField::End(end) => {
                let number = self.number_of(text.value.trim());
                self.draft.edges[edge].ends[end] = number;
                if number == ABSENT {
                    let name = text.value.trim().to_owned();
                    self.draft.loose.push(((text.place)(), name));
                }
            }
            EdgeField::EndCoordinate(end, axis, unit) => {
                let value = self.draft.place_in(text.number()?, unit);
                self.ends[end][axis] = value;
                self.edge_units[end] = Some(unit);
            }
            EdgeField::Radius(unit) | EdgeField::Width(unit) => {
                let share = if matches!(field, EdgeField::Width(_)) {
                    0.5
                } else {
                    1.0
                };
                if let Some(radius) = text.radius(share)? {
                    let radius = self.draft.radius_units.millimetres(radius, unit);
                    let is_other = |other: f64| (radius - other).abs() > SAME_RADIUS * other.abs();
                    if self.edge_radius.is_some_and(is_other) {
                        return Err(text.refused(
                            "the edge has another radius or width too, and a width is twice its radius: \
                             leave one of them out",
                        ));
                    }
                    self.edge_radius = Some(radius);
                    let radii = self.draft.edges[edge].radii.iter_mut();
                    for (end, _) in radii.zip(self.has_end_radius).filter(|both| !both.1) {
                        *end = Some(radius);
                    }
                }
            }
            EdgeField::EndRadius(end, unit) => {
                if let Some(radius) = text.radius(1.0)? {
                    let radius = self.draft.radius_units.millimetres(radius, unit);
                    self.draft.edges[edge].radii[end] = Some(radius);
                    self.has_end_radius[end] = true;
                }
            }
            EdgeField::Weight if !self.is_in_rows => self.ignore("edge", "weight"),
            EdgeField::Weight => return self.length(edge, Unit::OfTheFile, text),
            EdgeField::Length(unit) => return self.length(edge, unit, text),
            EdgeField::Course(unit) => return self.course(edge, unit, false, text),
            EdgeField::CourseInRows(unit) => return self.course(edge, unit, true, text),
            EdgeField::Nothing => {}
            EdgeField::Order => {
                if text.value.trim().is_empty() {
                    return Ok(());
                }
                let order = text.value.trim().parse::<f64>().ok();
                let order = order.filter(|o| o.fract() == 0.0 && (1.0..=255.0).contains(o));
                let order = order.ok_or_else(|| text.refused(ALLOWED_ORDERS))?;
                self.draft.edges[edge].order = Some(order as u8);
            }
        }
        Ok(())
    }

    fn length(&mut self, edge: usize, unit: Unit, text: Text<'_>) -> Result<(), ImportError> {
        if text.value.trim().is_empty() {
            return Ok(());
        }
        let length = text.number()?;
        if !(length.is_finite() && length >= 0.0) {
            return Err(text.refused("it must be a finite number of at least 0"));
        }
        let length = self.draft.length_units.millimetres(length, unit);
        self.draft.lengths.insert(edge as u32, length);
        Ok(())
    }

    fn course(
        &mut self,
        edge: usize,
        unit: Unit,
        in_rows: bool,
        text: Text<'_>,
    ) -> Result<(), ImportError> {
        let allowed = "it must be a list of points, each of two finite numbers";
        let all = numbers(text.value).ok_or_else(|| text.refused(allowed))?;
        if all.len() % 2 != 0 || all.iter().any(|number| !number.is_finite()) {
            return Err(text.refused(allowed));
        }
        if all.is_empty() {
            return Ok(());
        }
        let points = all.chunks_exact(2).map(|pair| {
            let pair = if in_rows {
                [pair[1], pair[0]]
            } else {
                [pair[0], pair[1]]
            };
            DVec2::from(pair.map(|value| self.draft.place_in(value, unit)))
        });
        let points = points.collect();
        self.draft.courses.insert(edge as u32, points);
        Ok(())
    }

    /// Ends an edge whose nodes have names or numbers.
    pub(super) fn edge_is_done(&mut self, place: Place<'_>) {
        // A radius at one end alone holds for both.
        if let Some(edge) = self.draft.edges.last_mut() {
            edge.radii = match edge.radii {
                [Some(only), None] | [None, Some(only)] => [Some(only); 2],
                both => both,
            };
            if edge.bad_radius().is_some() {
                let number = self.draft.edges.len() - 1;
                self.draft.bad_radii.insert(number, place());
            }
        }
    }

    /// Ends an edge that tells where its ends are; ends at one place are one node.
    pub(super) fn edge_with_places_is_done(
        &mut self,
        names: [Option<&str>; 2],
        place: Place<'_>,
    ) -> Result<(), ImportError> {
        for (end, name) in names.into_iter().enumerate() {
            let [x, y] = self.ends[end];
            if self.edge_units[end].is_none() {
                let problem = "an edge needs the places of both its ends";
                return Err(ImportError::at(place(), problem));
            }
            let known = match name {
                Some(name) => self.numbers.get(name).copied(),
                None => self.by_place.get(&bits([x, y])).copied(),
            };
            let here = DVec2::new(x, y);
            let node = known.unwrap_or_else(|| self.add(here, name));
            let there = self.draft.places[node as usize];
            // NaN in the line that makes a node is listed later with all others.
            if bits(there.into()) != bits(here.into()) {
                let (name, DVec2 { x: a, y: b }) = (self.draft.name(node), there);
                let problem = format!(
                    "node {name} is at ({x}, {y}) here and at ({a}, {b}) in an earlier line"
                );
                return Err(ImportError::at(place(), problem));
            }
            let edge = self.draft.edges.len() - 1;
            self.draft.edges[edge].ends[end] = node;
        }
        self.edge_is_done(place);
        Ok(())
    }

    /// Adds a whole node.
    fn add(&mut self, place: DVec2, name: Option<&str>) -> u32 {
        let node = self.draft.places.len() as u32;
        self.draft.places.push(place);
        match name {
            Some(name) => {
                self.draft.names.push(name.to_owned());
                self.numbers.insert(name.to_owned(), node);
            }
            None => {
                self.by_place.insert(bits(place.into()), node);
            }
        }
        node
    }

    /// The node at a place, made if there is none yet.
    pub(super) fn node_at(&mut self, place: DVec2) -> u32 {
        let known = self.by_place.get(&bits(place.into())).copied();
        known.unwrap_or_else(|| self.add(place, None))
    }

    /// The node in a row and a column of a picture, made if there is none yet.
    pub(super) fn node_in_rows(&mut self, [row, column]: [f64; 2]) -> u32 {
        let place = [column, row].map(|value| self.draft.place_in(value, Unit::OfTheFile));
        self.node_at(place.into())
    }

    fn number_of(&self, name: &str) -> u32 {
        if let Some(&number) = self.numbers.get(name) {
            return number;
        }
        if !self.draft.names.is_empty() {
            return ABSENT;
        }
        // Without names nodes are numbered from 0; a table may hold the numbers as 3.0.
        let number = name.parse::<f64>().ok();
        let number = number.filter(|n| n.fract() == 0.0 && *n >= 0.0);
        let number = number.filter(|n| *n < self.draft.places.len() as f64);
        number.map_or(ABSENT, |n| n as u32)
    }
}

/// What a key stands for, out of what was found before.
fn looked_up<F: Copy>(
    known: &mut HashMap<String, Option<F>>,
    key: &str,
    of: impl FnOnce(&str) -> Option<F>,
) -> Option<F> {
    if let Some(field) = known.get(key) {
        return *field;
    }
    let field = of(key);
    known.insert(key.to_owned(), field);
    field
}

/// The bits of a place, −0 the same as 0.
fn bits(place: [f64; 2]) -> [u64; 2] {
    place.map(|value| (value + 0.0).to_bits())
}
