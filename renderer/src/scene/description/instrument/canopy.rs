//! `[instruments.NAME.canopy]`.

use glam::DVec2;
use leafmodel::document::declared::{Declared, Defaults};
use leafmodel::document::keys::Keys;
use leafmodel::document::names::NameIn;
use leafmodel::document::number_lists::{Rectangle, Rising};

use super::detector::Detector;
use super::incidence::Incidence;
use crate::geometry::instance::COORDINATES_M;
use crate::scene::angle::declare_compass;

/// What `constituents` of an instrument means.
pub(super) const BY_CONSTITUENT: &str = "Whether absorption is told by constituents of tissue: pigments, water \
    and dry matter.";

/// Fluxes of a canopy that repeats itself without end along x and y.
#[derive(Clone, Debug, Declared, Defaults)]
#[key(last = Self::check)]
pub struct Canopy {
    /// The box that repeats itself: least x and y, greatest x and y.
    #[key("within_m", required, Rectangle(COORDINATES_M), default = [DVec2::ZERO, DVec2::ONE])]
    pub within: [DVec2; 2],
    /// The light; angles from +z.
    #[key(with = Self::declare_incidence, default = Incidence::beam())]
    pub incidence: Incidence,
    /// The object that is the soil, so that what arrives there is told.
    ///
    /// Index into [`Description::objects`](super::super::Description::objects).
    #[key("soil", NameIn("objects", "the name of an object"))]
    pub soil: Option<usize>,
    /// Heights between layers whose absorption is told one by one.
    #[key("layers_m", HEIGHTS)]
    pub layers: Vec<f64>,
    /// Whether absorption is told by constituents of tissue.
    #[key("constituents", about = BY_CONSTITUENT)]
    pub constituents: bool,
    /// Whether absorption is told of each instance of an object: leaf by leaf.
    #[key("instances")]
    pub instances: bool,
    /// Independent draws of all that is scattered or floats, over which figures are means; their errors
    /// then hold for any such leaves.
    #[key("realisations", 1..=10_000, default = 1)]
    pub realisations: u32,
    /// Directions from which the canopy is seen; `None` measures fluxes alone.
    #[key(with = Self::declare_detector)]
    pub detector: Option<Detector>,
}

const HEIGHTS: Rising = Rising {
    limits: COORDINATES_M,
    most: 1000,
    wanted: "a list of 1 to 1000 heights, rising",
};

impl Canopy {
    fn declare_incidence(&mut self, keys: &mut Keys<'_>) {
        let about = [
            "Angles of parallel light from +z, such as zenith angles of the sun.",
            "Azimuth from which that light comes, from +x towards +y.",
        ];
        self.incidence.declare_from(about, keys);
        if let Some(azimuth) = declare_compass(keys) {
            self.incidence.azimuth = azimuth.to_radians();
        }
    }

    fn declare_detector(&mut self, keys: &mut Keys<'_>) {
        let light = self.incidence.azimuth;
        let about = "Directions from which the canopy is seen, for its BRF.";
        let new = Detector::default;
        let declare = |own: &mut Detector, keys: &mut Keys<'_>| own.declare_by_compass(light, keys);
        keys.optional_block("detector", &mut self.detector, new, about, declare);
    }

    fn check(&mut self, keys: &mut Keys<'_>) {
        if self.instances && self.realisations > 1 {
            let problem = "instances of one draw are not those of another".to_owned();
            let help = "leave out `instances`, or `realisations`";
            keys.refuse(&["realisations"], problem, help);
        }
    }
}
