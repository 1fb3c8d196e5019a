//! What a picture tells of its scene, besides light.

use serde::{Deserialize, Serialize};

use crate::camera::view::View;
use crate::image::light_colour::LightColour;
use crate::scene::description::{Description, FilmKind, Picture};

/// What is needed to make a picture of sums without the scene's files.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Caption {
    /// The scene's name.
    pub name: String,
    /// The scene file as written, after overrides.
    pub source: String,
    /// Names of the objects, in the scene's order.
    pub objects: Vec<String>,
    /// What colours its lights have on the film.
    pub lights: Vec<LightColour>,
    /// What the film records.
    pub kind: FilmKind,
    /// The view.
    pub camera: View,
    /// How the PNG is made.
    pub picture: Picture,
}

impl Caption {
    /// The caption of a scene's pictures, with its [view](crate::scene::world::World::view) and the
    /// [colours of its lights](crate::scene::world::World::light_colours).
    pub fn of(scene: &Description, view: &View, lights: &[LightColour]) -> Self {
        let objects = scene.objects.iter();
        Self {
            name: scene.name.clone(),
            source: scene.source.clone(),
            objects: objects.map(|object| object.name.clone()).collect(),
            lights: lights.to_vec(),
            kind: scene.film.kind.clone(),
            camera: view.clone(),
            picture: scene.picture.clone(),
        }
    }
}
