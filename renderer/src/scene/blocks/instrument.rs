//! `[instruments.NAME.…]`: sphere, goniometer, canopy, depth.

mod bands;
mod canopy;
mod depth;
mod detector;
mod fluorescence;
pub(super) mod incident;
mod sample;

use glam::DVec2;
use leafmodel::document::context::Context;
use leafmodel::document::error::DocumentError;
use leafmodel::document::keys::{Keys, Variant};
use leafmodel::document::limits::Limits;
use leafmodel::document::schema::Type;
use leafmodel::document::tree::{Node, Value};
use leafmodel::document::value_kind::{Degrees, Flag, Kind, Number, degrees};
use leafmodel::document::values::{list, number, number_at, wrong_length, wrong_type};

use super::film::{Range, WAVELENGTHS_NM};
use crate::scene::authored::Authored;
use crate::scene::description::{
    Canopy, DepthProfile, Detector, Gonio, Incidence, Instrument, InstrumentKind, Named, Sample,
};

/// What `constituents` of an instrument means.
const BY_CONSTITUENT: &str = "Whether absorption is told by constituents of tissue: pigments, water \
    and dry matter.";
/// Most wavelengths of an instrument: more than one for each nanometre from 400 to 2500.
const MOST_WAVELENGTHS: usize = 4096;
/// Most directions of parallel light of an instrument.
const MOST_ANGLES: usize = 90;
/// Angles of beams from a normal.
const ANGLES_DEG: Limits = Limits::below(0.0, 90.0);

impl Instrument {
    /// One of the kind with all defaults.
    pub(in crate::scene) fn usual(kind: InstrumentKind) -> Self {
        Self {
            at: String::new(),
            wavelengths_nm: every(USUAL_RANGE_NM, USUAL_STEP_NM),
            bands: Vec::new(),
            indices: Vec::new(),
            incident: None,
            kind,
            fluorescence: None,
        }
    }
}

impl Default for Incidence {
    fn default() -> Self {
        Self {
            angles: Vec::new(),
            azimuth: 0.0,
            diffuse: false,
        }
    }
}

const USUAL_RANGE_NM: [f64; 2] = [400.0, 2500.0];
const USUAL_STEP_NM: f64 = 10.0;

const KINDS: [Variant<Instrument>; 4] = [
    Variant {
        name: "sphere",
        about: "An integrating sphere: reflectance, transmittance and absorptance of an object.",
        new: || Instrument::usual(InstrumentKind::Sphere(Sample::usual())),
        is: |instrument| matches!(instrument.kind, InstrumentKind::Sphere(_)),
        declare: |instrument, keys| {
            wavelengths(instrument, keys);
            if let InstrumentKind::Sphere(own) = &mut instrument.kind {
                sample::sample(own, keys);
                keys.key("constituents", &mut own.constituents, Flag, BY_CONSTITUENT);
            }
            incident::incident(instrument, keys);
            fluorescence::fluorescence(&mut instrument.fluorescence, keys);
        },
    },
    Variant {
        name: "gonio",
        about: "A goniometer: BRDF, BTDF and reflectance factors of an object by direction.",
        new: || {
            Instrument::usual(InstrumentKind::Gonio(Gonio {
                sample: Sample::beams_alone(),
                detector: Detector::usual(),
            }))
        },
        is: |instrument| matches!(instrument.kind, InstrumentKind::Gonio(_)),
        declare: |instrument, keys| {
            wavelengths(instrument, keys);
            if let InstrumentKind::Gonio(own) = &mut instrument.kind {
                sample::sample(&mut own.sample, keys);
                let about = "Directions from which it is seen, before and behind.";
                let own = &mut own.detector;
                keys.block("detector", about, |keys| detector::detector(own, keys));
            }
        },
    },
    Variant {
        name: "canopy",
        about: "Fluxes of a canopy that repeats itself without end along x and y.",
        new: || Instrument::usual(InstrumentKind::Canopy(Canopy::usual())),
        is: |instrument| matches!(instrument.kind, InstrumentKind::Canopy(_)),
        declare: |instrument, keys| {
            wavelengths(instrument, keys);
            if let InstrumentKind::Canopy(own) = &mut instrument.kind {
                canopy::canopy(own, keys);
            }
            incident::incident(instrument, keys);
            fluorescence::fluorescence(&mut instrument.fluorescence, keys);
        },
    },
    Variant {
        name: "depth",
        about: "Light by depth within a leaf of layers.",
        new: || Instrument::usual(InstrumentKind::Depth(DepthProfile::usual())),
        is: |instrument| matches!(instrument.kind, InstrumentKind::Depth(_)),
        declare: |instrument, keys| {
            wavelengths(instrument, keys);
            if let InstrumentKind::Depth(own) = &mut instrument.kind {
                depth::depth(own, keys);
            }
        },
    },
];

/// The keys of one of `[instruments]`.
pub(super) fn instrument(instrument: &mut Instrument, keys: &mut Keys<'_>) {
    keys.kind(instrument, &KINDS);
    // The kind makes a new one, so the place comes last.
    if let Some(block) = keys.reader() {
        instrument.at = block.cx.shown(&block.at);
    }
}

/// From here on spectra must cover what the instruments need, if they are what the scene is read
/// for; `None` if there is none.
pub(super) fn tell_range(scene: &Authored, keys: &Keys<'_>) {
    let Some(block) = keys.reader() else {
        return;
    };
    let ranges = scene.instruments.iter();
    let ranges = ranges.filter_map(|Named { value, .. }| value.range_nm());
    let all = ranges.reduce(|[low, high], [from, to]| [low.min(from), high.max(to)]);
    block.cx.range_nm.set(all);
    block.cx.needed_by.set("an instrument");
}

/// `wavelengths_nm`, or `range_nm` and `step_nm`.
fn wavelengths(instrument: &mut Instrument, keys: &mut Keys<'_>) {
    let mut range = USUAL_RANGE_NM;
    let about = "First and last wavelength.";
    keys.key("range_nm", &mut range, Range, about);
    let mut step = USUAL_STEP_NM;
    let limits = Number(Limits::closed(0.1, 1000.0));
    let about = "From one wavelength to the next.";
    keys.key("step_nm", &mut step, limits, about);
    let mut listed = None;
    let kind = Rising {
        limits: WAVELENGTHS_NM,
        most: MOST_WAVELENGTHS,
        what: "a list of 1 to 4096 wavelengths, rising",
    };
    let about = "The wavelengths one by one, instead of the two keys above.";
    keys.optional("wavelengths_nm", &mut listed, kind, about);
    keys.exclude("wavelengths_nm", "range_nm");
    keys.exclude("wavelengths_nm", "step_nm");
    let count = (range[1] - range[0]) / step;
    if count >= MOST_WAVELENGTHS as f64 {
        let problem = format!("gives more than {MOST_WAVELENGTHS} wavelengths");
        keys.refuse(
            &["step_nm"],
            problem,
            "use longer steps or a narrower range",
        );
        return;
    }
    bands::bands(instrument, keys);
    // Whoever asks for bands alone gets bands alone.
    let is_asked = keys.reader().is_none_or(|block| {
        let ranged = ["range_nm", "step_nm"];
        ranged.iter().any(|key| block.table.get(key).is_some())
    });
    instrument.wavelengths_nm = listed.unwrap_or_else(|| {
        if is_asked || instrument.bands.is_empty() {
            every(range, step)
        } else {
            Vec::new()
        }
    });
}

/// Wavelengths from the first to the last at equal steps, nm.
fn every([first, last]: [f64; 2], step: f64) -> Vec<f64> {
    // A range that is a whole number of steps keeps its end despite rounding.
    let steps = ((last - first) / step + 1e-9).floor() as u32;
    (0..=steps)
        .map(|i| (first + step * f64::from(i)).min(last))
        .collect()
}

/// `incidence_deg`, `azimuth_deg` and `diffuse`; `from` says from what the angles are counted.
fn incidence(incidence: &mut Incidence, keys: &mut Keys<'_>, [from, about]: [&'static str; 2]) {
    let mut angles_deg: Vec<f64> = incidence.angles.iter().copied().map(degrees).collect();
    let kind = Rising {
        limits: ANGLES_DEG,
        most: MOST_ANGLES,
        what: "a list of 1 to 90 angles, rising",
    };
    keys.key("incidence_deg", &mut angles_deg, kind, from);
    incidence.angles = angles_deg.into_iter().map(f64::to_radians).collect();
    let limits = Degrees(Limits::closed(-360.0, 360.0));
    keys.key("azimuth_deg", &mut incidence.azimuth, limits, about);
    let about = "Whether even light from the whole hemisphere is measured too.";
    keys.key("diffuse", &mut incidence.diffuse, Flag, about);
}

/// A rectangle's least and greatest corner from its four coordinates; reported if it has no area.
fn rectangle([x0, y0, x1, y1]: [f64; 4], key: &'static str, keys: &Keys<'_>) -> [DVec2; 2] {
    if x0 >= x1 || y0 >= y1 {
        let problem = "the rectangle has no area".to_owned();
        let help = format!("write the least x and y first: `{key} = [-1, -1, 1, 1]`");
        keys.refuse(&[key], problem, &help);
    }
    [DVec2::new(x0, y0), DVec2::new(x1, y1)]
}

/// A list of numbers, each greater than the one before.
#[derive(Clone, Copy, Debug)]
struct Rising {
    limits: Limits,
    most: usize,
    what: &'static str,
}

impl Kind for Rising {
    type Of = Vec<f64>;

    fn read(&self, cx: &Context, node: &Node, key: &str) -> Option<Vec<f64>> {
        let Value::List(nodes) = &node.value else {
            wrong_type(cx, node, key, self.what);
            return None;
        };
        if nodes.is_empty() || nodes.len() > self.most {
            wrong_length(cx, &node.at, key, "a list", nodes.len(), self.what);
            return None;
        }
        let errors = cx.error_count();
        let mut numbers: Vec<f64> = Vec::with_capacity(nodes.len());
        for node in nodes {
            let Some(value) = number_at(cx, node, key, self.limits) else {
                continue;
            };
            if let Some(&before) = numbers.last().filter(|before| **before >= value) {
                let error = DocumentError::NotRising {
                    key: key.to_owned(),
                    before,
                    after: value,
                };
                cx.error(&node.at, error);
                break;
            }
            numbers.push(value);
        }
        (cx.error_count() == errors).then_some(numbers)
    }

    fn write(&self, numbers: &Vec<f64>) -> Value {
        list(numbers.iter().copied().map(number))
    }

    fn describe(&self) -> Type {
        Type::List {
            of: Box::new(Type::Number(self.limits)),
            least: 1,
            most: self.most,
            wanted: self.what,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_range_of_wavelengths_has_both_ends_where_steps_fit_and_never_more() {
        assert_eq!(every([400.0, 2500.0], 10.0).len(), 211);
        assert_eq!(every([400.0, 2500.0], 10.0)[210], 2500.0);
        assert_eq!(every([400.0, 401.0], 0.1).len(), 11);
        assert_eq!(every([400.0, 405.0], 2.0), [400.0, 402.0, 404.0]);
        assert_eq!(every([400.0, 405.0], 50.0), [400.0]);
    }
}
