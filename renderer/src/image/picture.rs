//! Pictures: layers of numbers with names and attributes.

pub use crate::spectrum::rgb::{LUMINANCE, luminance};

/// One channel.
#[derive(Clone, Debug, PartialEq)]
pub struct Layer {
    /// The whole channel name: `R`, `albedo.R`, `S0.550,000000nm`.
    pub name: String,
    /// Values by row, from the top, and column.
    pub data: Vec<f32>,
}

/// Channels of one size, with attributes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Picture {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Channels. Files hold them in the order of their names.
    pub layers: Vec<Layer>,
    /// Names and values of attributes. Files hold them in the order of their names.
    pub attributes: Vec<(String, Attribute)>,
}

impl Layer {
    /// A channel with a name.
    pub fn new(name: impl Into<String>, data: Vec<f32>) -> Self {
        let name = name.into();
        Self { name, data }
    }
}

impl Picture {
    /// A picture without attributes.
    pub fn new([width, height]: [u32; 2], layers: impl IntoIterator<Item = Layer>) -> Self {
        Self {
            width,
            height,
            layers: layers.into_iter().collect(),
            attributes: Vec::new(),
        }
    }

    /// A picture of the colours that an RGB space has, with its primaries and white.
    pub(super) fn of_colours(
        size: [u32; 2],
        channels: [Vec<f32>; 3],
        space: [[f32; 2]; 4],
    ) -> Self {
        let layers = ["R", "G", "B"].into_iter().zip(channels);
        let mut picture = Self::new(size, layers.map(|(name, data)| Layer::new(name, data)));
        let space = Attribute::Chromaticities(space);
        picture
            .attributes
            .push(("chromaticities".to_owned(), space));
        picture
    }
    /// The channel with a name.
    pub fn layer(&self, name: &str) -> Option<&Layer> {
        self.layers.iter().find(|layer| layer.name == name)
    }

    /// The text of the attribute with a name.
    pub fn text(&self, name: &str) -> Option<&str> {
        match self.attribute(name) {
            Some(Attribute::Text(text)) => Some(text),
            _ => None,
        }
    }

    /// The attribute with a name.
    pub fn attribute(&self, name: &str) -> Option<&Attribute> {
        let mut all = self.attributes.iter();
        all.find_map(|(known, value)| (known == name).then_some(value))
    }
}

/// The value of an attribute.
#[derive(Clone, Debug, PartialEq)]
pub enum Attribute {
    /// Text of any length.
    Text(String),
    /// A 32-bit number.
    Float(f32),
    /// A 64-bit number.
    Double(f64),
    /// A whole number.
    Int(i32),
    /// A 4 × 4 matrix, row by row, for row vectors (the convention of `OpenEXR`).
    Matrix4([f32; 16]),
    /// CIE 1931 x, y of red, green, blue and white.
    Chromaticities([[f32; 2]; 4]),
}

/// Rec. 709 primaries and D65: what linear sRGB means.
pub const REC709: Attribute = Attribute::Chromaticities(REC709_POINTS);

/// x and y of red, green, blue and white of Rec. 709.
pub(super) const REC709_POINTS: [[f32; 2]; 4] =
    [[0.64, 0.33], [0.30, 0.60], [0.15, 0.06], [0.3127, 0.3290]];
