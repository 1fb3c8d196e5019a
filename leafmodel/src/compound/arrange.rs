//! Places of leaflets and stalks.

use glam::DVec2;

use super::arranged::{CompoundLeaf, PlacedLeaflet, Stalk, StalkKind, direction};
use super::form::CompoundForm;
use super::stray::{Part, Stray, Strayed};
use super::{Arrangement, Feather};

/// Widest angle from its axis of what strays, radians.
const WIDEST: f64 = 3.0;
/// Number of straight pieces of a rachis between two leaflets.
const PIECES: u32 = 4;

/// The place on an axis where a leaflet or pinna is inserted, and its angle.
struct Insertion {
    /// Point and direction of the axis there.
    at: DVec2,
    heading: f64,
    /// Distance along the axis.
    along: f64,
    /// Angle from the axis, > 0 to the right; 0 at its end.
    angle: f64,
    size: f64,
    /// What chance adds to the angle by which a pinna turns.
    turn: f64,
}

/// A point on an axis of length `length` that starts at `base` towards `heading` and turns evenly,
/// and the axis' direction there.
fn on_arc(base: DVec2, heading: f64, length: f64, turn: f64, along: f64) -> (DVec2, f64) {
    let turned = turn * along / length;
    // Chord of the arc: sin(t/2)/(t/2) of its length, half-way between the directions.
    let half = 0.5 * turned;
    let chord = if half.abs() < 1e-6 {
        along
    } else {
        along * libm::sin(half) / half
    };
    (base + direction(heading + half) * chord, heading + turned)
}

impl Feather {
    /// Size at a share of the rachis, linear between first, middle and last.
    fn size(&self, share: f64) -> f64 {
        let [first, middle, last] = self.sizes;
        if share < 0.5 {
            first + (middle - first) * 2.0 * share
        } else {
            middle + (last - middle) * (2.0 * share - 1.0)
        }
    }

    /// The insertions on a rachis of this length, from its base on; the one with a number strays
    /// that far.
    fn insertions(
        &self,
        base: DVec2,
        heading: f64,
        length: f64,
        strayed: impl Fn(usize) -> Strayed,
    ) -> Vec<Insertion> {
        let pairs = f64::from(self.pairs);
        // A terminal leaflet is inserted one gap beyond the last pair; without one the last pair is
        // at the rachis' end.
        let gaps = pairs - 1.0 + self.alternation + if self.terminal { 1.0 } else { 0.0 };
        let mut all = Vec::with_capacity(self.count());
        for i in 0..self.pairs {
            let share = if self.pairs > 1 {
                f64::from(i) / (pairs - 1.0)
            } else {
                0.5
            };
            for (side, offset) in [(1.0, 0.0), (-1.0, self.alternation)] {
                let by = strayed(all.len());
                // The rachis ends with its last pair, which stays.
                let shift = if i + 1 == self.pairs && !self.terminal {
                    0.0
                } else {
                    by.along
                };
                // A single pair is at the end.
                let along = if gaps > 0.0 {
                    ((f64::from(i) + offset + shift) * (length / gaps)).clamp(0.0, length)
                } else {
                    length
                };
                let (at, heading) = on_arc(base, heading, length, self.turn, along);
                let [first, last] = self.angles;
                all.push(Insertion {
                    at,
                    heading,
                    along,
                    angle: side * ((first + (last - first) * share) * by.angle).min(WIDEST),
                    size: (self.size(share) * by.size).min(1.0),
                    turn: by.turn,
                });
            }
        }
        if self.terminal {
            let (at, heading) = on_arc(base, heading, length, self.turn, length);
            let by = strayed(all.len());
            all.push(Insertion {
                at,
                heading,
                along: length,
                angle: by.angle - 1.0,
                size: (self.sizes[2] * by.size).min(1.0),
                turn: by.turn,
            });
        }
        all
    }
}

/// A compound leaf under construction.
struct Builder<'p> {
    plan: &'p CompoundForm,
    stray: &'p Stray,
    /// Length of the largest leaflet, mm.
    unit: f64,
    leaf: CompoundLeaf,
}

/// Arranges the leaflets of a checked plan.
pub(super) fn arrange(plan: &CompoundForm, unit: f64, stray: &Stray) -> CompoundLeaf {
    let mut builder = Builder {
        plan,
        stray,
        unit,
        leaf: CompoundLeaf {
            leaflets: Vec::new(),
            stalks: Vec::new(),
        },
    };
    let end = DVec2::new(0.0, plan.petiole * unit);
    // Its radius depends on everything it bears, which is known only at the end.
    let has_petiole = plan.petiole > 0.0;
    if has_petiole {
        builder.stalk(StalkKind::Petiole, vec![DVec2::ZERO, end], Vec::new());
    }
    let flow = match &plan.arrangement {
        Arrangement::Pinnate(feather) => {
            let length = feather.rachis * unit;
            builder.feather(
                StalkKind::Rachis,
                feather,
                (end, 0.0),
                length,
                Part::Leaflet,
                |builder, insertion| builder.leaflet(insertion, insertion.size),
            )
        }
        Arrangement::Palmate {
            leaflets,
            spread,
            sizes,
        } => builder.fan(end, *leaflets, *spread, *sizes),
        Arrangement::Bipinnate {
            pinnae,
            leaflets,
            stalk,
        } => {
            let pinna = leaflets.rachis * unit;
            builder.feather(
                StalkKind::Rachis,
                pinnae,
                (end, 0.0),
                pinnae.rachis * pinna,
                Part::Pinna,
                |builder, insertion| builder.pinna(leaflets, insertion, stalk * unit, pinna),
            )
        }
    };
    if has_petiole {
        let radius = builder.radius(flow);
        builder.leaf.stalks[0].radii_mm = vec![radius; 2];
    }
    builder.leaf
}

impl Builder<'_> {
    fn stalk(&mut self, kind: StalkKind, points: Vec<DVec2>, radii_mm: Vec<f64>) {
        self.leaf.stalks.push(Stalk {
            kind,
            points,
            radii_mm,
        });
    }

    /// Cross-sections add up: that of a stalk is the sum of those of the petiolules that it bears.
    fn radius(&self, flow: f64) -> f64 {
        self.plan.stalk_radius_mm * flow.sqrt()
    }

    /// Adds a leaflet and its stalk; returns its flow, in units of the largest leaflet's.
    fn leaflet(&mut self, insertion: &Insertion, scale: f64) -> f64 {
        let angle = insertion.heading + insertion.angle;
        let stalk = self.plan.petiolule * scale * self.unit;
        let base = insertion.at + direction(angle) * stalk;
        let flow = scale * scale;
        if stalk > 0.0 {
            let radius = self.radius(flow);
            self.stalk(
                StalkKind::Petiolule,
                vec![insertion.at, base],
                vec![radius; 2],
            );
        }
        let number = self.leaf.leaflets.len() as u32;
        self.leaf.leaflets.push(PlacedLeaflet {
            variant: number % self.plan.variants,
            foot: insertion.at,
            from_axis: insertion.angle,
            base,
            angle,
            scale,
            mirrored: insertion.angle < 0.0,
        });
        flow
    }

    /// Adds an axis and its leaflets or pinnae, which `part` numbers; returns their total flow.
    fn feather(
        &mut self,
        kind: StalkKind,
        feather: &Feather,
        (base, heading): (DVec2, f64),
        length: f64,
        part: fn(usize) -> Part,
        mut bear: impl FnMut(&mut Self, &Insertion) -> f64,
    ) -> f64 {
        // A leaf has one row of pinnae; of leaflets it has one for each pinna.
        let before = match part(0) {
            Part::Leaflet(_) => self.leaf.leaflets.len(),
            Part::Pinna(_) => 0,
        };
        let insertions = feather.insertions(base, heading, length, |number| {
            self.stray.of(part(before + number))
        });
        let place = self.leaf.stalks.len();
        self.stalk(kind, Vec::new(), Vec::new());
        let flows: Vec<f64> = insertions
            .iter()
            .map(|insertion| bear(self, insertion))
            .collect();
        let pieces = PIECES * (feather.pairs + 1);
        let (mut points, mut radii) = (Vec::new(), Vec::new());
        // Evenly spaced places, and the insertions.
        let mut places: Vec<f64> = (0..=pieces)
            .map(|i| length * f64::from(i) / f64::from(pieces))
            .chain(insertions.iter().map(|insertion| insertion.along))
            .collect();
        places.sort_by(f64::total_cmp);
        places.dedup_by(|a, b| *a - *b < 1e-9 * length);
        for along in places {
            points.push(on_arc(base, heading, length, feather.turn, along).0);
            // The flow of all insertions farther out; at the very end, of those there.
            let beyond = insertions.iter().zip(&flows);
            let reached = along.min(length * (1.0 - 1e-9));
            let flow: f64 = beyond
                .filter(|(insertion, _)| insertion.along >= reached)
                .map(|(_, flow)| flow)
                .sum();
            radii.push(self.radius(flow));
        }
        self.leaf.stalks[place].points = points;
        self.leaf.stalks[place].radii_mm = radii;
        flows.iter().sum()
    }

    /// Adds a pinna: a bare stalk, then its leaflets.
    fn pinna(&mut self, leaflets: &Feather, insertion: &Insertion, stalk: f64, length: f64) -> f64 {
        let heading = insertion.heading + insertion.angle;
        let size = insertion.size;
        let base = insertion.at + direction(heading) * (stalk * size);
        let place = self.leaf.stalks.len();
        // Pinnae on the left are mirror images.
        let mirrored = insertion.angle < 0.0;
        let turn = if mirrored {
            -leaflets.turn
        } else {
            leaflets.turn
        };
        let own = Feather {
            turn: turn + insertion.turn,
            ..*leaflets
        };
        let flow = self.feather(
            StalkKind::Pinna,
            &own,
            (base, heading),
            length * size,
            Part::Leaflet,
            |builder, on| builder.leaflet(on, on.size * size),
        );
        let radius = self.radius(flow);
        self.leaf.stalks[place].points.insert(0, insertion.at);
        self.leaf.stalks[place].radii_mm.insert(0, radius);
        flow
    }

    /// Adds leaflets around the petiole's end, from right to left.
    fn fan(&mut self, at: DVec2, leaflets: u32, spread: f64, [outer, middle]: [f64; 2]) -> f64 {
        let mut flow = 0.0;
        for i in 0..leaflets {
            let share = 1.0 - 2.0 * f64::from(i) / f64::from(leaflets - 1);
            let by = self.stray.of(Part::Leaflet(i as usize));
            let size = ((middle + (outer - middle) * share.abs()) * by.size).min(1.0);
            // By a share of the angle between neighbours: the one ahead strays as far as the others.
            let between = spread / f64::from(leaflets - 1);
            let insertion = Insertion {
                at,
                heading: 0.0,
                along: 0.0,
                angle: 0.5 * spread * share + between * (by.angle - 1.0),
                size,
                turn: 0.0,
            };
            flow += self.leaflet(&insertion, size);
        }
        flow
    }
}
