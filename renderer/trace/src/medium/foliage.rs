//! Foliage: leaves without extent, by how they are inclined.

use std::f64::consts::PI;

use glam::{Vec2, Vec3};
use libm::{acos, sincos};

use crate::geometry::scatter::Inclination;

/// Inclinations that stand for the distribution.
const CLASSES: usize = 256;
/// Steps of the cosine between a way and the vertical.
const STEPS: usize = 256;

/// What leaves turn to light by its direction, and the leaves that light meets.
#[derive(Clone, Debug)]
pub(super) struct Foliage {
    /// Cosine and sine of the inclination of each class.
    classes: Vec<[f64; 2]>,
    /// For each cosine of the way, and each class, the fraction of its area that all leaves up to that class turn to light.
    turned: Vec<f32>,
}

impl Foliage {
    pub(super) fn new(inclination: &Inclination) -> Self {
        // Narrow at both ends, where few leaves may turn most of their area to grazing light.
        let below = |class: usize| {
            let along = class as f64 / CLASSES as f64;
            along * along * (3.0 - 2.0 * along)
        };
        let classes = (0..CLASSES).map(|class| {
            let (sin, cos) = sincos(inclination.angle(0.5 * (below(class) + below(class + 1))));
            [cos, sin]
        });
        let classes: Vec<[f64; 2]> = classes.collect();
        let row = |step: usize| {
            let cos = step as f64 / STEPS as f64;
            let sin = (1.0 - cos * cos).sqrt();
            let mut sum = 0.0;
            let up_to = classes.iter().enumerate().map(move |(class, own)| {
                let area = below(class + 1) - below(class);
                sum += Azimuths::new([cos, sin], *own).mean() * area;
                sum as f32
            });
            up_to.collect::<Vec<f32>>()
        };
        Self {
            turned: (0..=STEPS).flat_map(row).collect(),
            classes,
        }
    }

    /// The fraction of their area that leaves turn to light that goes `way`, of any length.
    pub(super) fn turned(&self, way: Vec3) -> f32 {
        Place::of(way).up_to(&self.turned, CLASSES - 1)
    }

    /// The normal of a leaf that light meets, on the side to which the light goes on; the numbers are in [0, 1).
    pub(super) fn normal(&self, way: Vec3, u: Vec2) -> Vec3 {
        let place = Place::of(way);
        let target = u.x * place.up_to(&self.turned, CLASSES - 1);
        let (mut low, mut high) = (0, CLASSES - 1);
        while low < high {
            let middle = usize::midpoint(low, high);
            if place.up_to(&self.turned, middle) > target {
                high = middle;
            } else {
                low = middle + 1;
            }
        }
        // The leaf's azimuth from the way's, to either side.
        let (cos, sin) = (f64::from(place.cos), f64::from(place.sin));
        let [own_cos, own_sin] = self.classes[low];
        let twice = 2.0 * f64::from(u.y);
        let azimuth = Azimuths::new([cos, sin], [own_cos, own_sin]).at(twice.fract());
        let (own_y, own_x) = sincos(if twice < 1.0 { azimuth } else { -azimuth });
        // All as if light went up; a normal has no sign of its own.
        let level = Vec2::new(way.x, way.y) * way.z.signum();
        let ahead = level.try_normalize().unwrap_or(Vec2::X);
        let across = ahead.perp();
        let level = (ahead * own_x as f32 + across * own_y as f32) * own_sin as f32;
        let normal = level.extend(own_cos as f32).normalize();
        if normal.dot(way) < 0.0 {
            -normal
        } else {
            normal
        }
    }
}

/// A way, by its angle with the vertical: between which steps it lies.
struct Place {
    cos: f32,
    sin: f32,
    step: usize,
    beyond: f32,
}

impl Place {
    fn of(way: Vec3) -> Self {
        let sin = Vec2::new(way.x, way.y).length();
        let length = way.length();
        let cos = (way.z.abs() / length).min(1.0);
        let along = cos * STEPS as f32;
        let step = (along as usize).min(STEPS - 1);
        Self {
            cos,
            sin: sin / length,
            step,
            beyond: along - step as f32,
        }
    }

    fn up_to(&self, turned: &[f32], class: usize) -> f32 {
        let low = turned[self.step * CLASSES + class];
        let high = turned[(self.step + 1) * CLASSES + class];
        low + (high - low) * self.beyond
    }
}

/// Leaves of one inclination, in all azimuths alike, before light: the cosine of the angle between light and normal is
/// a + b cos φ, of whose amount φ from 0 to π is drawn.
///
/// # Source
///
/// \[ross1981\]: the mean of the amount.
struct Azimuths {
    a: f64,
    b: f64,
    /// Where the cosine changes its sign.
    edge: f64,
}

impl Azimuths {
    fn new([cos, sin]: [f64; 2], [own_cos, own_sin]: [f64; 2]) -> Self {
        let (a, b) = (cos * own_cos, sin * own_sin);
        let edge = if a < b { acos(-a / b) } else { PI };
        Self { a, b, edge }
    }

    /// The integral of a + b cos φ.
    fn signed(&self, azimuth: f64) -> f64 {
        self.a * azimuth + self.b * sincos(azimuth).0
    }

    /// The integral of the amount, from 0 to π.
    fn whole(&self) -> f64 {
        2.0 * self.signed(self.edge) - PI * self.a
    }

    fn mean(&self) -> f64 {
        self.whole() / PI
    }

    /// The azimuth below which a fraction of the integral lies.
    fn at(&self, fraction: f64) -> f64 {
        let (target, top) = (fraction * self.whole(), self.signed(self.edge));
        let is_first = target < top;
        let target = if is_first { target } else { 2.0 * top - target };
        let (mut low, mut high) = if is_first {
            (0.0, self.edge)
        } else {
            (self.edge, PI)
        };
        let mut azimuth = 0.5 * (low + high);
        // Newton's steps where they stay between the bounds, else halves.
        for _ in 0..60 {
            let (sin, cos) = sincos(azimuth);
            let off = self.a * azimuth + self.b * sin - target;
            if (off < 0.0) == is_first {
                low = azimuth;
            } else {
                high = azimuth;
            }
            let next = azimuth - off / (self.a + self.b * cos);
            let next = if next > low && next < high {
                next
            } else {
                0.5 * (low + high)
            };
            if (next - azimuth).abs() < 1e-9 {
                break;
            }
            azimuth = next;
        }
        azimuth
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::scatter::InclinationTable;
    use crate::sampling::stream::Stream;

    fn at(cos: f64, azimuth: f64) -> Vec3 {
        let (sin_azimuth, cos_azimuth) = sincos(azimuth);
        let sin = (1.0 - cos * cos).sqrt();
        Vec3::new(
            (sin * cos_azimuth) as f32,
            (sin * sin_azimuth) as f32,
            cos as f32,
        )
    }

    fn inclinations() -> Vec<Inclination> {
        let table = InclinationTable::new(vec![[10.0, 1.0], [30.0, 0.0], [70.0, 2.0]]);
        vec![
            Inclination::Spherical,
            Inclination::Uniform,
            Inclination::Planophile,
            Inclination::Erectophile,
            Inclination::Plagiophile,
            Inclination::Extremophile,
            Inclination::Beta {
                mu: 0.1,
                nu: 1000.0,
            },
            Inclination::Beta { mu: 0.4, nu: 0.4 },
            Inclination::Ellipsoidal { chi: 0.01 },
            Inclination::Ellipsoidal { chi: 100.0 },
            Inclination::Table(table.expect("it can be used")),
        ]
    }

    /// The integral over normals of their density times something of normal and inclination.
    fn over_normals(inclination: &Inclination, of: impl Fn(Vec3) -> f64) -> f64 {
        let (steps, around) = (4000, 128);
        let mut sum = 0.0;
        for step in 0..steps {
            let angle = inclination.angle((f64::from(step) + 0.5) / f64::from(steps));
            for turn in 0..around {
                let azimuth = 2.0 * PI * (f64::from(turn) + 0.5) / f64::from(around);
                sum += of(at(libm::cos(angle), azimuth));
            }
        }
        sum / f64::from(steps * around)
    }

    #[test]
    fn leaves_turn_to_light_what_the_integral_over_their_normals_says() {
        for inclination in inclinations() {
            let foliage = Foliage::new(&inclination);
            for cos in [0.0, 0.003, 0.31, 0.7, 0.97, 1.0] {
                let way = at(cos, 1.0);
                let expected =
                    over_normals(&inclination, |normal| f64::from(normal.dot(way).abs()));
                for way in [way, -way, 3.0 * way] {
                    let found = f64::from(foliage.turned(way));
                    assert!(
                        (found - expected).abs() < 2e-4,
                        "{inclination:?} {cos}: {found} {expected}"
                    );
                }
            }
        }
        // Spherical leaves turn half of their area to light from everywhere; those of an ellipsoid as Campbell has it.
        for chi in [0.3, 1.0, 4.0_f64] {
            let foliage = Foliage::new(&Inclination::Ellipsoidal { chi });
            let square = (1.0 - chi.powi(2).min(chi.powi(-2))).sqrt();
            let whole = match chi {
                1.0 => 2.0,
                _ if chi < 1.0 => chi + square.asin() / square,
                _ => chi + ((1.0 + square) / (1.0 - square)).ln() / (2.0 * square * chi),
            };
            for cos in [0.0, 0.2, 0.8, 1.0_f64] {
                let expected = (chi * chi * cos * cos + 1.0 - cos * cos).sqrt() / whole;
                let found = f64::from(foliage.turned(at(cos, 0.0)));
                assert!(
                    (found - expected).abs() < 1e-4,
                    "{chi} {cos}: {found} {expected}"
                );
            }
        }
    }

    #[test]
    fn leaves_are_met_as_often_as_they_are_turned_to_light() {
        // Moments of the normals, with weights by what is turned, in three directions.
        for inclination in inclinations() {
            let foliage = Foliage::new(&inclination);
            for way in [Vec3::Z, at(0.6, 2.0), -at(0.02, 4.0), at(0.6, 2.0) * -1.0] {
                let count = 1 << 14;
                for probe in [Vec3::Z, Vec3::X, at(0.5, 1.3)] {
                    let of = |normal: Vec3| f64::from(normal.dot(probe)).powi(2);
                    let mut found = 0.0;
                    for number in 0..count {
                        let [x, y, ..] = Stream::new(1, 0, 0, number).next4();
                        let normal = foliage.normal(way, Vec2::new(x, y));
                        assert!((normal.length() - 1.0).abs() < 1e-5 && normal.dot(way) >= -1e-6);
                        found += of(normal) / f64::from(count);
                    }
                    let turned = |normal: Vec3| f64::from(normal.dot(way).abs());
                    let all = over_normals(&inclination, turned);
                    let expected =
                        over_normals(&inclination, |normal| turned(normal) * of(normal)) / all;
                    assert!(
                        (found - expected).abs() < 2e-3,
                        "{inclination:?} {way}: {found} {expected}"
                    );
                }
            }
        }
    }

    #[test]
    fn spherical_leaves_scatter_as_a_lambertian_sphere_does() {
        // Lit faces send light by the angle b from its way as 2 (sin b − b cos b) / 3π², and what passes them the mirrored way.
        let foliage = Foliage::new(&Inclination::Spherical);
        let way = at(0.3, 0.4);
        let count = 1 << 15;
        for cos in [-1.0, -0.7, 0.0, 0.4, 0.99_f64] {
            let ahead = way.any_orthonormal_vector();
            let next = way * cos as f32 + ahead * (1.0 - cos * cos).sqrt() as f32;
            for through in [0.0, 0.3] {
                let mut found = 0.0;
                for number in 0..count {
                    let [x, y, ..] = Stream::new(2, 0, 0, number).next4();
                    let normal = foliage.normal(way, Vec2::new(x, y));
                    let phase = crate::medium::Phase::Leaf { normal, through };
                    found += f64::from(phase.value(way, next)) / f64::from(count);
                }
                let lobe = |angle: f64| {
                    2.0 / (3.0 * PI * PI) * (libm::sin(angle) - angle * libm::cos(angle))
                };
                let (b, part) = (acos(cos), f64::from(through));
                let expected = (1.0 - part) * lobe(b) + part * lobe(PI - b);
                assert!(
                    (found - expected).abs() < 1e-3,
                    "{cos} {through}: {found} {expected}"
                );
            }
        }
    }
}
