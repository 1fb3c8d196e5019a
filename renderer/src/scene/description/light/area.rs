//! An object whose surface shines.

use std::path::PathBuf;

use glam::Vec2;
use leafmodel::document::coverage::require_coverage;
use leafmodel::document::declared::{Declared, Defaults};
use leafmodel::document::keys::Keys;
use leafmodel::document::names::NameIn;

use super::surroundings::{LightError, PICTURE, Surroundings, read_picture};
use crate::geometry::TriangleMesh;
use crate::light::area::AreaLight;
use crate::light::pattern::{Colours, Pattern};
use crate::light::texels::Texels;
use crate::material::colour_map::ColourMap;
use crate::plugin::element::Element;
use crate::plugin::spectra::Spectra;
use crate::plugin::{colours, emitter, light_id, weights_file};
use crate::scene::blocks::spectrum::SpectrumOf;
use crate::scene::description::layer::ChosenLayer;
use crate::spectrum::written::Spectrum;
use crate::spectrum::{Curve, rgb};

const OBJECT: NameIn = NameIn("objects", "the name of an object that shines");

/// An object whose surface shines on the side of its normal.
#[derive(Clone, Debug, Declared, Defaults)]
pub struct Area {
    /// An object with a mesh, in one place, with no other area light.
    ///
    /// Its default is replaced when the key is read.
    #[key("object", required, OBJECT, default = usize::MAX)]
    pub object: usize,
    /// Its radiance; in the middle, where `edge_share` or a picture change it.
    ///
    /// W m⁻² sr⁻¹ nm⁻¹; with a pattern, where that is 1.
    #[key("radiance_w_m2_sr_nm", required, SpectrumOf::Emission)]
    pub radiance: Spectrum,
    /// How the radiance varies over the texture coordinates.
    #[key(flat)]
    pub pattern: AreaPattern,
}

/// How the radiance of an area light varies ([`Pattern`]).
#[derive(Clone, Debug, PartialEq, Declared, Defaults)]
#[key(last = check_pattern)]
pub struct AreaPattern {
    /// Radiance in the middle of each edge over that in the middle, as on the cloth of a soft box: a bell over
    /// the mesh's texture coordinates. 1 is even.
    #[key("edge_share", above(0.0, 1.0), default = 1.0)]
    pub edge: f64,
    /// A picture over the mesh's texture coordinates, upright, that multiplies the radiance: what RGB 1 1 1
    /// stands for is `radiance_w_m2_sr_nm`.
    ///
    /// EXR, Radiance HDR, PNG or JPEG with RGB, resolved and inside the scene's folder.
    #[key("picture", PICTURE)]
    pub picture: Option<PathBuf>,
    /// The layer of the picture.
    #[key(flat)]
    pub layer: ChosenLayer,
    /// Whether the light that the materials of the object's glTF file emit multiplies the radiance: what an
    /// emission of RGB 1 1 1 stands for is `radiance_w_m2_sr_nm`.
    #[key("emission")]
    pub emission: bool,
}

impl AreaPattern {
    /// Whether there is none: the radiance is the same everywhere.
    pub fn is_even(&self) -> bool {
        self.edge >= 1.0 && self.picture.is_none() && !self.emission
    }
}

/// Conditions between the keys of a pattern.
fn check_pattern(pattern: &mut AreaPattern, keys: &mut Keys<'_>) {
    keys.exclude("emission", "picture");
    let has_picture = pattern.picture.is_some();
    if pattern.layer.name().is_some() && !has_picture && keys.reader().is_some() {
        let problem = "there is no picture that could have layers".to_owned();
        keys.refuse(&["layer"], problem, "write `picture` too, or leave it out");
    }
    if (has_picture || pattern.emission)
        && let Some(block) = keys.reader()
    {
        let key = if pattern.emission {
            "emission"
        } else {
            "picture"
        };
        let at = block.node(key).map_or(&block.at, |node| &node.at);
        require_coverage(block.cx, at, "a picture's colour", rgb::RANGE_NM);
    }
}

impl Area {
    pub(super) fn built(&self, mut around: Surroundings<'_>) -> Result<AreaLight, LightError> {
        let surface = around.surface.take();
        let surface = surface.expect("the world gives the surface of what shines");
        let (mesh, to_world) = (surface.mesh, surface.to_world);
        let radiance = Curve::from_description(&self.radiance);
        let mirrored = to_world.matrix3.determinant() < 0.0;
        let triangles = corners(mesh, mirrored, |vertex| {
            to_world.transform_point3(mesh.positions()[vertex])
        });
        let pattern = &self.pattern;
        if pattern.is_even() {
            return Ok(AreaLight::new(&triangles, radiance));
        }
        // A model without pictures needs none.
        let needs_uvs = !pattern.emission || pattern.edge < 1.0;
        if mesh.uvs().is_none() && needs_uvs {
            let name = around.name.to_owned();
            return Err(LightError::NoTextureCoordinates { name });
        }
        let uv_of = |vertex: usize| mesh.uvs().map_or(Vec2::ZERO, |uvs| uvs[vertex]);
        let uvs = corners(mesh, mirrored, uv_of);
        let colours = match (&pattern.picture, surface.emission) {
            (Some(file), _) => {
                let picture = read_picture(file, pattern.layer.name(), &mut around)?;
                Some(Colours::Picture(Texels::new(picture.texels, picture.width)))
            }
            (None, Some(map)) if pattern.emission => {
                if map.greatest() == [0.0; 3] {
                    let name = around.name.to_owned();
                    return Err(LightError::NoEmission { name });
                }
                Some(Colours::Model(map.clone()))
            }
            (None, _) => None,
        };
        let pattern = Pattern::new(pattern.edge, colours);
        Ok(AreaLight::with_pattern(&triangles, &uvs, radiance, pattern))
    }

    /// The emitter of the object's shape, for the light of this name; `emission` is what the materials of its
    /// model emit.
    pub(crate) fn emitter(
        &self,
        light: &str,
        emission: Option<&ColourMap>,
        spectra: &mut Spectra,
    ) -> Element {
        let even = spectra.element("radiance", &self.radiance, 1.0);
        let pattern = &self.pattern;
        if pattern.is_even() {
            return emitter::area(even);
        }
        let texture = Element::plugin("texture", "lamina_pattern").with("name", "radiance");
        let texture = texture.holding(even).float("edge_share", pattern.edge);
        emitter::area(if emission.is_some() {
            texture.holding(colours::texture(&light_id(light), "colours", emission))
        } else if pattern.picture.is_some() {
            // The spectra of red, green and blue under an even white of 1.
            let primaries = rgb::Primaries::new(Curve::Constant(1.0)).curves();
            let named = ["red", "green", "blue"].into_iter().zip(&primaries);
            let primaries = named.map(|(name, curve)| spectra.element(name, &curve.written(), 1.0));
            texture
                .string("picture", weights_file(light))
                .holding_all(primaries)
        } else {
            texture
        })
    }
}

/// What the three corners of each face have, counter-clockwise in the world.
fn corners<T>(mesh: &TriangleMesh, mirrored: bool, of: impl Fn(usize) -> T) -> Vec<[T; 3]> {
    let faces = mesh.triangles().iter();
    faces
        .map(|&[a, b, c]| {
            let face = if mirrored { [a, c, b] } else { [a, b, c] };
            face.map(|vertex| of(vertex as usize))
        })
        .collect()
}
