//! What stands in a scene, and where.

use glam::{DMat4, DVec3, Mat3};
use leafmodel::document::declared::{Declared, Defaults};
use leafmodel::document::keys::Keys;
use leafmodel::document::names::NameIn;
use leafmodel::document::value_kind::Integer;
use leafmodel::plan_file::DAYS;

use super::name_list::{IndicesIn, NamesIn};
use crate::geometry::scatter::{Amount, MOST_AT_REST, Rest, Scatter, Volume};

/// Meshes, leaves or bodies placed in the scene: one shape in one place, or any number of
/// instances. The default has no shape, and is at the origin.
#[derive(Clone, Debug, Default)]
pub struct Object {
    /// Its shapes, at least one. Without instances there is exactly one.
    pub shapes: Vec<ObjectShape>,
    /// Local to world, metres, affine and invertible. For instances, the frame in which their
    /// places are given; for what is strewn, what is done with the shape before.
    pub to_world: DMat4,
    /// The places of instances; `None` means the single place `to_world`.
    pub instances: Option<Vec<InstancePlace>>,
    /// Where it is strewn; its places follow when the world is built. The parts of a plant then
    /// have their places in the plant's frame.
    pub strewn: Option<Box<StrewnOn>>,
    /// The box in which copies of it float; their places follow when the world is built.
    pub volume: Option<Box<Volume>>,
    /// Whether the camera sees a hole in its place: black, with an alpha of 0.
    pub holdout: bool,
}

impl Object {
    /// The mesh of its first shape, index into [`Description::meshes`](super::Description::meshes).
    pub fn first_mesh(&self) -> Option<usize> {
        Some(self.shapes.first()?.mesh()?.0)
    }

    /// Whether its places are found when the world is built.
    pub fn is_spread(&self) -> bool {
        self.strewn.is_some() || self.volume.is_some()
    }
}

/// Where copies of an object are strewn.
#[derive(Clone, Debug, Declared, Defaults)]
#[key(last = Self::check)]
pub struct StrewnOn {
    /// The object over whose surface they are strewn, in all its places.
    #[key("on", required, NameIn("objects", "the name of an object"))]
    pub on: usize,
    /// Other objects on which they come to rest.
    #[key("over", IndicesIn(NamesIn("objects", "the name of an object")))]
    pub over: Vec<usize>,
    /// How many and how.
    #[key(flat)]
    pub plan: Scatter,
    /// Different leaves of each kind that are grown for it.
    #[key("individuals", 1..=1000, default = 1)]
    pub individuals: u32,
    /// Days of ageing of the first and the last of them, the others between; the leaves need
    /// `senescence` by `day`.
    ///
    /// `None` leaves them as they are.
    #[key("days", within(DAYS))]
    pub days: Option<[f64; 2]>,
}

impl StrewnOn {
    fn check(&mut self, keys: &mut Keys<'_>) {
        if self.plan.scale[0] > self.plan.scale[1] {
            let problem = "the least factor is greater than the greatest".to_owned();
            keys.refuse(&["scale"], problem, "write the smaller one first");
        }
        let settles = matches!(self.plan.rest, Rest::Settled { .. });
        for (key, needs_rest) in [
            ("over", true),
            ("gap_mm", true),
            ("sink_mm", false),
            ("furrows", false),
            ("merge", false),
            ("upright", false),
        ] {
            if keys.reader().is_some() && keys.has(key) && needs_rest != settles {
                let (problem, help) = if settles {
                    (
                        "has no effect on what settles",
                        "take it out, or leave `settle` out",
                    )
                } else {
                    (
                        "has an effect only on what settles",
                        "write `settle = true` beside it",
                    )
                };
                keys.refuse(&[key], problem.to_owned(), help);
            }
        }
        if let Amount::Count(count) = self.plan.amount
            && settles
            && count as usize > MOST_AT_REST
        {
            let problem = format!("{count} are more than the {MOST_AT_REST} that may settle");
            keys.refuse(&["count"], problem, "use fewer");
        }
        refuse_ages_of_one(self.individuals, self.days, keys);
        let about = "Same numbers and seed, same places.";
        let seed = Integer::within(0, u64::MAX);
        keys.key("seed", &mut self.plan.seed, seed, about);
    }
}

/// Refuses two ages of one individual.
pub(in crate::scene) fn refuse_ages_of_one(
    individuals: u32,
    days: Option<[f64; 2]>,
    keys: &Keys<'_>,
) {
    if individuals == 1 && days.is_some_and(|[first, last]| first != last) {
        let problem = "one individual has one age".to_owned();
        let help = "write `individuals = 5` beside it, or the same day twice";
        keys.refuse(&["days"], problem, help);
    }
}

/// The place and shape of one instance of an object.
///
/// It takes 64 bytes, since a scene may have millions. Directions and sizes are in single precision,
/// the place itself in double precision, so that it is exact anywhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InstancePlace {
    /// Index into [`Object::shapes`].
    pub shape: u32,
    /// Linear part of the transform from the shape's frame to the scene's, [`Object::to_world`]
    /// included.
    pub linear: Mat3,
    /// Where the origin of the shape's frame lies in the scene, m.
    pub translation: DVec3,
}

impl InstancePlace {
    /// A shape in the scene.
    pub fn new(shape: u32, to_world: DMat4) -> Self {
        Self {
            shape,
            linear: Mat3::from_mat4(to_world.as_mat4()),
            translation: to_world.w_axis.truncate(),
        }
    }

    /// Local to world.
    pub fn matrix(&self) -> DMat4 {
        DMat4::from_mat3_translation(self.linear.as_dmat3(), self.translation)
    }
}

/// The shape of an object.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ObjectShape {
    /// A mesh with a material.
    Mesh {
        /// Index into [`Description::meshes`](super::Description::meshes).
        mesh: usize,
        /// Index into [`Description::materials`](super::Description::materials).
        material: usize,
    },
    /// A grown leaf (base at the origin, midrib along +y, adaxial side +z).
    Leaf {
        /// Index into [`Description::leaves`](super::Description::leaves).
        leaf: usize,
    },
    /// A grown body of solid tissue, in the frame of its shape.
    Solid {
        /// Index into [`Description::solids`](super::Description::solids).
        solid: usize,
    },
}

impl ObjectShape {
    /// Its mesh and material.
    pub fn mesh(self) -> Option<(usize, usize)> {
        match self {
            Self::Mesh { mesh, material } => Some((mesh, material)),
            Self::Leaf { .. } | Self::Solid { .. } => None,
        }
    }

    /// Its leaf.
    pub fn leaf(self) -> Option<usize> {
        match self {
            Self::Leaf { leaf } => Some(leaf),
            Self::Mesh { .. } | Self::Solid { .. } => None,
        }
    }

    /// Its body.
    pub fn solid(self) -> Option<usize> {
        match self {
            Self::Solid { solid } => Some(solid),
            Self::Mesh { .. } | Self::Leaf { .. } => None,
        }
    }
}
