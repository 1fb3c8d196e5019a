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

impl FaultKind {
    /// Whether nothing can be measured with it.
    pub fn is_error(self) -> bool {
        match self {
            Self::LooseEnd | Self::BadPlace | Self::BadRadius => true,
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
            | Self::OutsideMargin
            | Self::Hidden
            | Self::NoStroke
            | Self::NoShape
            | Self::Clip
            | Self::StyleRule
            | Self::Uneven
            | Self::Ignored
            | Self::Guess
            | Self::Bent
            | Self::ShortLength => false,
        }
    }

    /// Whether it is as it should be, and only told.
    pub fn is_note(self) -> bool {
        matches!(
            self,
            Self::OutsideMargin
                | Self::Hidden
                | Self::NoStroke
                | Self::NoShape
                | Self::Ignored
                | Self::Guess
                | Self::Bent
        )
    }

    /// A word for files.
    pub fn word(self) -> &'static str {
        match self {
            Self::LooseEnd => "loose_end",
            Self::BadPlace => "bad_place",
            Self::BadRadius => "bad_radius",
            Self::NoLength => "no_length",
            Self::TwiceJoined => "twice_joined",
            Self::SamePlace => "same_place",
            Self::Crossing => "crossing",
            Self::Touch => "touch",
            Self::Apart => "apart",
            Self::Bare => "bare_node",
            Self::NoRoot => "no_root",
            Self::Turned => "turned",
            Self::Widening => "widening",
            Self::NoRadius => "no_radius",
            Self::OutsideMargin => "outside_margin",
            Self::Hidden => "hidden",
            Self::NoStroke => "no_stroke",
            Self::NoShape => "no_shape",
            Self::Clip => "clip",
            Self::StyleRule => "style_rule",
            Self::Uneven => "uneven_stroke",
            Self::Ignored => "ignored",
            Self::Guess => "guess",
            Self::Bent => "bent",
            Self::ShortLength => "short_length",
        }
    }

    /// What it is, and what was done about it.
    fn sentence(self) -> &'static str {
        match self {
            Self::LooseEnd => "edges lead to nodes that do not exist",
            Self::BadPlace => {
                "nodes have a coordinate that is not a finite number within 10⁶ mm of the origin"
            }
            Self::BadRadius => "radii are not finite numbers above 0",
            Self::NoLength => "edges have no length; they are left out",
            Self::TwiceJoined => "pairs of nodes are joined twice; the wider edge is kept",
            Self::SamePlace => "nodes lie where another one does; they are made one",
            Self::Crossing => "crossings of veins have no node; the veins are cut there",
            Self::Touch => "nodes lie on veins that do not end there; the veins are cut there",
            Self::Apart => "parts do not hang together with the part at the petiole",
            Self::Bare => "nodes have no vein; they are left out",
            Self::NoRoot => {
                "nothing says where the petiole is (--root X,Y does), so an end of a vein is taken for it"
            }
            Self::Turned => {
                "edges did not lead away from the petiole; all are turned by their distance from it along veins"
            }
            Self::NoRadius => {
                "edges have no radius or width, so those of all others are left out; measures of widths, and \
                 of vein orders that are not in the file, are missing"
            }
            Self::Widening => {
                "edges get wider away from the petiole; their mean radius is taken at both ends"
            }
            Self::OutsideMargin => {
                "nodes lie outside the margin, as those of a petiole do; their edges are left out"
            }
            Self::Hidden => "elements of the drawing are hidden; they are left out",
            Self::NoStroke => "shapes of the drawing have no stroke; they are left out",
            Self::NoShape => {
                "elements of the drawing are neither paths nor basic shapes; they are left out"
            }
            Self::Clip => {
                "clip paths and masks of the drawing are not applied; what they hide is read"
            }
            Self::Uneven => {
                "strokes are scaled unevenly, so that their widths differ by direction; the mean width is taken"
            }
            Self::Ignored => "parts of the file are not known; they are left out",
            Self::Guess => "guesses about how tables are written",
            Self::Bent => {
                "edges are longer than the straight line between their ends; they are drawn as arcs of their \
                 length, so areas of areoles, angles and distances to veins are approximate"
            }
            Self::ShortLength => {
                "edges are shorter than the straight line between their ends; that line is taken"
            }
            Self::StyleRule => "parts of style sheets are not understood; they are left out",
        }
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
        let mut line = format!("{} ({})", self.kind.sentence(), self.count);
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
