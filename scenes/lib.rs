//! Scenes that the program carries, so that a first picture needs no checkout.
//!
//! `lamina example` writes them into a folder. They are those of this folder that need few and small
//! files.
//!
//! ```
//! let first = lamina_scenes::find("first-leaf").expect("it is carried");
//! assert_eq!(first.files[0].name, "scene.toml");
//! assert!(first.about().starts_with("One leaf held against a low sun"));
//! ```

/// A scene with the files that it reads.
#[derive(Clone, Copy, Debug)]
pub struct Scene {
    /// Its name, which is also that of its folder.
    pub name: &'static str,
    /// Its files; the first is `scene.toml`.
    pub files: &'static [SceneFile],
}

/// A file of a scene.
#[derive(Clone, Copy, Debug)]
pub struct SceneFile {
    /// Its name in the scene's folder.
    pub name: &'static str,
    /// What it holds.
    pub bytes: &'static [u8],
}

/// A scene of this folder with its files.
macro_rules! scene {
    ($name:literal: $($file:literal),+) => {
        Scene {
            name: $name,
            files: &[$(SceneFile {
                name: $file,
                bytes: include_bytes!(concat!($name, "/", $file)),
            }),+],
        }
    };
}

/// All scenes that are carried, the one for a start first.
pub const SCENES: [Scene; 4] = [
    scene!("first-leaf": "scene.toml", "evening.png"),
    scene!("flat-leaf": "scene.toml"),
    scene!("milk-glass": "scene.toml"),
    scene!("trillium": "scene.toml"),
];

/// The scene of a name.
pub fn find(name: &str) -> Option<&'static Scene> {
    SCENES.iter().find(|scene| scene.name == name)
}

impl Scene {
    /// A sentence on what it shows: the comment that its file begins with.
    pub fn about(&self) -> &'static str {
        let text = str::from_utf8(self.files[0].bytes).expect("a scene file is UTF-8");
        let comment = text.lines().next().and_then(|line| line.strip_prefix("# "));
        comment.expect("a scene that is carried begins with a comment")
    }
}
