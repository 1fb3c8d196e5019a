//! The equilibrium of a blade as a shell.

use std::f64::consts::FRAC_PI_2;

use glam::{DMat3, DVec2, DVec3};

use super::plan::Stance;
use super::tissue;
use crate::blade::form::Bending;
use crate::blade::plan::BladeForm;
use crate::blade::pleats::Pleats;
use crate::blade::relief::Relief;
use crate::shape::outline::Outline;
use crate::shell::{Clamp, Effort, Grid, Ground, Sheet, Skin, relaxed};
use crate::venation::network::{VeinSegment, VenationNetwork};

/// Cells of the first search, and of the second, which begins where the first has ended.
const CELLS: [f64; 2] = [240.0, 700.0];
const EFFORTS: [Effort; 2] = [
    Effort {
        steps: 50,
        tolerance: 5e-4,
    },
    Effort {
        steps: 7,
        tolerance: 1e-3,
    },
];
/// Stiffness of what holds the base, N/mm.
const HOLDER: f64 = 50.0;
/// Pressure of the ground over depth, N/mm³.
const GROUND: f64 = 1e-3;

/// Where the points of a blade have come to lie.
#[derive(Clone, Debug, PartialEq)]
pub struct Settled {
    grid: Grid,
    /// The grid's control points in the form of the turgid leaf, mm.
    rest: Vec<DVec3>,
    /// The same where the blade has come to lie.
    at: Vec<DVec3>,
    turn: DMat3,
    sag: f64,
    on_ground: bool,
}

impl Settled {
    /// The equilibrium of the blade within `outline`, of tissue that holds so much water (cm) and
    /// dry matter (g/cm²), on a stalk of this length and radius (mm) if it has one.
    ///
    /// `None` if nothing has happened to the blade.
    pub fn of(
        stance: &Stance,
        form: &BladeForm,
        (outline, network): (&Outline, &VenationNetwork),
        water_and_dry_matter: [f64; 2],
        stalk: Option<[f64; 2]>,
        seed: u64,
    ) -> Option<Self> {
        if stance.is_none() {
            return None;
        }
        let veins: Vec<VeinSegment> = network.segments().collect();
        let pleats = Pleats::new(form, outline, &veins);
        let relief = Relief::new(form, &form.major(&veins));
        // Ridges stand out on one side; what touches may come from either.
        let half_thickness = |p: DVec2| 0.5 * form.thickness_mm + relief.height(p);
        let weight = tissue::weight(stance, water_and_dry_matter);
        let sag = sag(stance, outline, weight, stalk);
        let mut settled: Option<Self> = None;
        for (cells, effort) in CELLS.into_iter().zip(EFFORTS) {
            let spacing = (outline.area() / cells).sqrt();
            let grid = Grid::over(outline.points(), |p| outline.contains(p), spacing);
            let bending =
                Bending::new(form, outline, network.map()).pleated(pleats.clone().seen_by(spacing));
            let skin = Skin::over(
                &grid,
                outline.points(),
                |p| outline.contains(p),
                half_thickness,
            );
            let patches = tissue::patches(&grid, stance, form, (outline, &veins), weight, seed);
            let rest = grid.fitted(|p| bending.place(p, 0.0));
            let sheet = |down: DVec3, ground: Option<Ground>| {
                let clamp = Clamp {
                    at: outline.base(),
                    stiffness: HOLDER,
                };
                let held = ground.is_none().then_some(clamp);
                Sheet::new(&grid, &rest, &patches, down, ground, held).keeping_clear(skin.clone())
            };
            let down = down(stance, sag);
            let mut x = match &settled {
                Some(before) => grid.fitted(|p| {
                    let form = [bending.place(p, 0.0), DVec3::ZERO, DVec3::ZERO];
                    before.carried(p, form)[0]
                }),
                None if stance.on_ground => {
                    // It dries first, and then it falls.
                    let (mut x, _) = relaxed(&sheet(DVec3::ZERO, None), &rest, effort);
                    let lowest = x.iter().map(|p| p.z).fold(f64::INFINITY, f64::min);
                    for p in &mut x {
                        p.z -= lowest;
                    }
                    x
                }
                None => rest.clone(),
            };
            let ground = stance.on_ground.then_some(Ground {
                height: 0.0,
                stiffness: GROUND,
            });
            x = relaxed(&sheet(down, ground), &x, effort).0;
            settled = Some(Self {
                grid,
                rest,
                at: x,
                turn: DMat3::from_cols(
                    DVec3::X,
                    DVec3::new(0.0, libm::cos(sag), -libm::sin(sag)),
                    DVec3::new(0.0, libm::sin(sag), libm::cos(sag)),
                ),
                sag,
                on_ground: stance.on_ground,
            });
        }
        settled
    }

    /// Where the flat point `p`, which `form` places in the turgid leaf (with its derivatives by the
    /// flat coordinates), has come to lie, likewise with derivatives. What the grid does not resolve
    /// of the form turns with the sheet.
    pub(super) fn carried(&self, p: DVec2, form: [DVec3; 3]) -> [DVec3; 3] {
        let rest = self.grid.value(&self.rest, p);
        let at = self.grid.value(&self.at, p);
        let frame = |[_, across, along]: [DVec3; 3]| {
            let x = across.normalize_or(DVec3::X);
            let z = across.cross(along).normalize_or(DVec3::Z);
            DMat3::from_cols(x, z.cross(x), z)
        };
        let turn = frame(at) * frame(rest).transpose();
        std::array::from_fn(|i| at[i] + turn * (form[i] - rest[i]))
    }

    /// A point of the blade after the stalk has sagged.
    pub(super) fn turned(&self, at: DVec3) -> DVec3 {
        self.turn * at
    }

    pub(super) fn turn(&self) -> DMat3 {
        self.turn
    }

    pub(super) fn sag(&self) -> f64 {
        self.sag
    }

    /// Whether the leaf lies on the ground.
    pub(crate) fn on_ground(&self) -> bool {
        self.on_ground
    }
}

/// The pull of weight on the blade in its own frame. The form of a turgid blade is that under its
/// weight; what has lost stiffness carries the rest no more.
fn down(stance: &Stance, sag: f64) -> DVec3 {
    if stance.on_ground {
        return -DVec3::Z;
    }
    let Some(wilting) = stance.wilting else {
        return DVec3::ZERO;
    };
    let pitch = wilting.pitch - sag;
    let lost = 1.0 - tissue::stiffness_left(stance);
    lost * DVec3::new(0.0, -libm::sin(pitch), -libm::cos(pitch))
}

/// The angle by which the stalk's end turns down under the blade: a beam held at its foot, of
/// stiffness `E π r⁴ / 4`, with the blade's weight and its moment at the end; it hangs at most
/// straight down.
fn sag(stance: &Stance, outline: &Outline, weight: f64, stalk: Option<[f64; 2]>) -> f64 {
    let (Some(wilting), Some([length, radius])) = (stance.wilting, stalk) else {
        return 0.0;
    };
    if stance.on_ground {
        return 0.0;
    }
    let stiffness =
        tissue::veins_modulus(stance) * 0.25 * std::f64::consts::PI * libm::pow(radius, 4.0);
    let force = weight * outline.area() * (1.0 - tissue::stiffness_left(stance));
    let arm = 0.5 * outline.length();
    let most = FRAC_PI_2 + wilting.pitch;
    let turned = force * length * (0.5 * length + arm) / stiffness * libm::cos(wilting.pitch);
    if most <= 0.0 {
        0.0
    } else {
        most * libm::tanh(turned / most)
    }
}
