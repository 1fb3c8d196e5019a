//! What is wrong with a network, with places.

use std::fmt::Write as _;

use glam::DVec2;

/// Greatest number of places of one kind of fault that a list shows.
const SHOWN: usize = 5;

/// A kind of fault. Errors make measuring senseless; the rest are warnings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum FaultKind {
    /// An edge leads to a node that does not exist.
    LooseEnd,
    /// A coordinate is NaN or infinite, or farther than 10⁶ mm from the origin.
    BadPlace,
    /// A radius is NaN, infinite, 0 or negative.
    BadRadius,
    /// An edge joins a node to itself, or two nodes at one place.
    NoLength,
    /// Two nodes are joined twice.
    TwiceJoined,
    /// Two nodes lie at one place.
    SamePlace,
    /// Two veins cross without a node.
    Crossing,
    /// A node lies on a vein that it is not part of.
    Touch,
    /// A part of the network does not hang together with the part at the petiole.
    Apart,
    /// A node has no edge.
    Bare,
    /// Nothing says at which node the petiole is: it was chosen.
    NoRoot,
    /// Edges do not lead away from the petiole, so they were turned.
    Turned,
    /// A vein gets wider away from the petiole.
    Widening,
    /// An edge has no radius, and others have one.
    NoRadius,
    /// A node lies outside the margin.
    OutsideMargin,
    /// An element of a drawing is hidden.
    Hidden,
    /// A shape of a drawing has no stroke.
    NoStroke,
    /// An element of a drawing is no shape: a text, a picture.
    NoShape,
    /// A clip path or a mask of a drawing.
    Clip,
    /// A part of a style sheet that is not understood.
    StyleRule,
    /// A stroke of a drawing is wider along one direction than along another.
    Uneven,
    /// Something of the file that is not known.
    Ignored,
    /// How a table is written was found from it.
    Guess,
    /// An edge is longer than the straight line between its ends.
    Bent,
    /// An edge is shorter than that line.
    ShortLength,
}

/// How much a fault matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Gravity {
    /// Nothing can be measured with it.
    Error,
    /// Measures may suffer.
    Warning,
    /// It is as it should be, and only reported.
    Note,
}

impl FaultKind {
    /// How much it matters.
    fn gravity(self) -> Gravity {
        match self {
            Self::LooseEnd | Self::BadPlace | Self::BadRadius => Gravity::Error,
            Self::NoLength
            | Self::TwiceJoined
            | Self::SamePlace
            | Self::Crossing
            | Self::Touch
            | Self::Apart
            | Self::Bare
            | Self::NoRoot
            | Self::Turned
            | Self::Widening
            | Self::NoRadius
            | Self::Clip
            | Self::StyleRule
            | Self::Uneven
            | Self::ShortLength => Gravity::Warning,
            Self::OutsideMargin
            | Self::Hidden
            | Self::NoStroke
            | Self::NoShape
            | Self::Ignored
            | Self::Guess
            | Self::Bent => Gravity::Note,
        }
    }

    /// A word for files, and what it is and what was done about it.
    fn facts(self) -> (&'static str, &'static str) {
        match self {
            Self::LooseEnd => ("loose_end", "edges lead to nodes that do not exist"),
            Self::BadPlace => (
                "bad_place",
                "nodes have a coordinate that is not a finite number within 10⁶ mm of the origin",
            ),
            Self::BadRadius => ("bad_radius", "radii are not finite numbers above 0"),
            Self::NoLength => ("no_length", "edges have no length; they are left out"),
            Self::TwiceJoined => (
                "twice_joined",
                "pairs of nodes are joined twice; the wider edge is kept",
            ),
            Self::SamePlace => (
                "same_place",
                "nodes lie where another one does; they are made one",
            ),
            Self::Crossing => (
                "crossing",
                "crossings of veins have no node; the veins are cut there",
            ),
            Self::Touch => (
                "touch",
                "nodes lie on veins that do not end there; the veins are cut there",
            ),
            Self::Apart => (
                "apart",
                "parts do not hang together with the part at the petiole",
            ),
            Self::Bare => ("bare_node", "nodes have no vein; they are left out"),
            Self::NoRoot => (
                "no_root",
                "nothing says where the petiole is (--root X,Y does), so an end of a vein is taken for it",
            ),
            Self::Turned => (
                "turned",
                "edges did not lead away from the petiole; all are turned by their distance from it along veins",
            ),
            Self::Widening => (
                "widening",
                "edges get wider away from the petiole; their mean radius is taken at both ends",
            ),
            Self::NoRadius => (
                "no_radius",
                "edges have no radius or width, so those of all others are left out; measures of widths, and \
                 of vein orders that are not in the file, are missing",
            ),
            Self::OutsideMargin => (
                "outside_margin",
                "nodes lie outside the margin, as those of a petiole do; their edges are left out",
            ),
            Self::Hidden => (
                "hidden",
                "elements of the drawing are hidden; they are left out",
            ),
            Self::NoStroke => (
                "no_stroke",
                "shapes of the drawing have no stroke; they are left out",
            ),
            Self::NoShape => (
                "no_shape",
                "elements of the drawing are neither paths nor basic shapes; they are left out",
            ),
            Self::Clip => (
                "clip",
                "clip paths and masks of the drawing are not applied; what they hide is read",
            ),
            Self::StyleRule => (
                "style_rule",
                "parts of style sheets are not understood; they are left out",
            ),
            Self::Uneven => (
                "uneven_stroke",
                "strokes are scaled unevenly, so that their widths differ by direction; the mean width is taken",
            ),
            Self::Ignored => (
                "ignored",
                "parts of the file are not known; they are left out",
            ),
            Self::Guess => ("guess", "guesses about how tables are written"),
            Self::Bent => (
                "bent",
                "edges are longer than the straight line between their ends; they are drawn as arcs of their \
                 length, so areas of areoles, angles and distances to veins are approximate",
            ),
            Self::ShortLength => (
                "short_length",
                "edges are shorter than the straight line between their ends; that line is taken",
            ),
        }
    }

    /// Whether nothing can be measured with it.
    pub(crate) fn is_error(self) -> bool {
        self.gravity() == Gravity::Error
    }

    /// Whether it is as it should be, and only reported.
    pub fn is_note(self) -> bool {
        self.gravity() == Gravity::Note
    }

    /// A word for files.
    pub fn word(self) -> &'static str {
        self.facts().0
    }
}

/// All faults of one kind.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// Its kind.
    pub kind: FaultKind,
    /// How many there are, ≥ 1.
    pub count: usize,
    /// Where, mm in the frame of the network; may be fewer than `count`, or none.
    pub places: Vec<DVec2>,
    /// Which, in the file's own words; as many as are shown at most.
    pub names: Vec<String>,
}

impl Fault {
    pub(super) fn new(kind: FaultKind) -> Self {
        Self {
            kind,
            count: 0,
            places: Vec::new(),
            names: Vec::new(),
        }
    }

    pub(super) fn at(&mut self, place: DVec2) {
        self.count += 1;
        self.places.push(place);
    }

    pub(super) fn named(&mut self, name: impl FnOnce() -> String) {
        self.count += 1;
        if self.names.len() < SHOWN {
            self.names.push(name());
        }
    }

    /// One line: what, how many, and where the first ones are.
    pub fn line(&self) -> String {
        let mut line = format!("{} ({})", self.kind.facts().1, self.count);
        let mut shown: Vec<String> = self.names.iter().take(SHOWN).cloned().collect();
        if shown.is_empty() {
            let places = self.places.iter().take(SHOWN);
            shown = places
                .map(|p| format!("({:.3}, {:.3}) mm", p.x, p.y))
                .collect();
        }
        if !shown.is_empty() {
            let _ = write!(line, ": {}", shown.join(", "));
            let more = self.count - shown.len().min(self.count);
            if more > 0 {
                let _ = write!(line, " and {more} more");
            }
        }
        line
    }
}

/// Faults as lines of a message, those that are errors first.
pub(super) fn listed(faults: &[Fault]) -> String {
    let mut lines: Vec<String> = Vec::new();
    for is_error in [true, false] {
        let these = faults
            .iter()
            .filter(|fault| fault.kind.is_error() == is_error);
        lines.extend(these.map(|fault| format!("  {}", fault.line())));
    }
    lines.join("\n")
}
