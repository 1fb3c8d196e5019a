//! What a picture tells of its scene, besides light.

use crate::camera::view::View;
use crate::scene::description::{Description, FilmKind, Picture};

/// What is needed to make a picture of sums without the scene's files.
#[derive(Clone, Debug)]
pub struct Caption {
    /// The scene's name.
    pub name: String,
    /// The scene file as written, after overrides.
    pub source: String,
    /// Names of the objects, in the scene's order.
    pub objects: Vec<String>,
    /// What the film records.
    pub kind: FilmKind,
    /// The view.
    pub camera: View,
    /// How the PNG is made.
    pub picture: Picture,
}

impl Caption {
    /// The caption of a scene's pictures, with its [view](crate::scene::world::World::view).
    pub fn of(scene: &Description, view: &View) -> Self {
        let objects = scene.objects.iter();
        Self {
            name: scene.name.clone(),
            source: scene.source.clone(),
            objects: objects.map(|object| object.name.clone()).collect(),
            kind: scene.film.kind.clone(),
            camera: view.clone(),
            picture: scene.picture.clone(),
        }
    }
}
