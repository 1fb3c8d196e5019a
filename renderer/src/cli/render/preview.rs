//! A look at a picture while it is rendered: as a file, and in the viewer tev.
//!
//! - **In**: the sums of a film at the border of two blocks of pixels.
//! - **Out**: the picture to look at, written anew; the radiance, sent to the viewer.
//! - **Always true**: the render and its bytes are what they are without; showing takes at most one
//!   part in fifty of the time; a failure is one warning.

use std::path::Path;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use serde_json::Value;

use super::pace::Pace;
use super::viewer::Viewer;
use crate::checkpoint::Heading;
use crate::cli::picture_files::kind_of;
use crate::film::Film;
use crate::image::display::colours;
use crate::image::{ImageError, Picture};
use crate::integrator::develop::seen;
use crate::integrator::layers::Layout;
use crate::integrator::render::Begun;

/// Time between two looks if nothing else is asked for.
pub(super) const USUAL: Duration = Duration::from_secs(5);

/// Who looks at a render.
pub(super) struct Preview<'a> {
    heading: &'a Heading,
    layout: Layout,
    /// The picture to look at, if it is written before it is done.
    shown: Option<&'a Path>,
    state: Mutex<PreviewState>,
}

struct PreviewState {
    viewer: Option<Viewer>,
    pace: Pace,
    /// How often it was shown.
    count: u32,
    has_warned: bool,
}

impl<'a> Preview<'a> {
    pub(super) fn new(
        heading: &'a Heading,
        layout: Layout,
        every: Duration,
        shown: Option<&'a Path>,
        viewer: Option<Viewer>,
    ) -> Self {
        Self {
            heading,
            layout,
            shown,
            state: Mutex::new(PreviewState {
                viewer,
                pace: Pace::new(every),
                count: 0,
                has_warned: false,
            }),
        }
    }

    fn state(&self) -> MutexGuard<'_, PreviewState> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Adds what showing has cost to a report.
    pub(super) fn report(&self, stats: &mut Value) {
        let state = self.state();
        stats["previews"] = state.count.into();
        stats["preview_seconds"] = state.pace.seconds.into();
    }

    /// Whether it is time to show the picture.
    pub(super) fn is_due(&self) -> bool {
        // A thread that cannot lock at once learns it with the next block.
        self.state.try_lock().is_ok_and(|state| {
            (self.shown.is_some() || state.viewer.is_some()) && state.pace.is_due(false)
        })
    }

    /// Shows the picture in the midst of the render.
    pub(super) fn show(&self, begun: &Begun) {
        if begun.film.drawn() > 0 {
            self.show_film(&begun.film, self.shown);
        } else {
            // There must be time for samples, or none would ever be drawn.
            self.state().pace.last = Instant::now();
        }
    }

    /// Sends the picture that is done to the viewer; its file is written as without a preview.
    pub(super) fn show_last(&self, film: &Film) {
        if self.state().viewer.is_some() && film.drawn() > 0 {
            self.show_film(film, None);
        }
    }

    fn show_film(&self, film: &Film, shown: Option<&Path>) {
        let started = Instant::now();
        let picture = seen(&self.heading.caption, film, self.layout);
        let state = &mut *self.state();
        if let Some(path) = shown
            && let Err(error) = self.write(&picture, path)
            && !std::mem::replace(&mut state.has_warned, true)
        {
            eprintln!("warning: no preview: {error}; rendering goes on");
        }
        if let Some(viewer) = &mut state.viewer {
            let colours = colours(&picture).map_err(|error| error.to_string());
            let sent = colours.and_then(|colours| {
                let sent = viewer.send(&colours);
                sent.map_err(|error| error.to_string())
            });
            if let Err(problem) = sent {
                eprintln!("warning: the viewer is gone: {problem}; rendering goes on");
                state.viewer = None;
            }
        }
        state.count += 1;
        state.pace.add(started);
    }

    fn write(&self, picture: &Picture, path: &Path) -> Result<(), ImageError> {
        let display = &self.heading.caption.picture;
        display.write(picture, kind_of(path), path)
    }
}

#[cfg(test)]
mod tests {
    use std::net::TcpListener;
    use std::path::Path;
    use std::sync::atomic::AtomicBool;

    use super::super::viewer::testing::received;
    use super::*;
    use crate::checkpoint::PROGRAM;
    use crate::image::Layer;
    use crate::integrator::caption::Caption;
    use crate::integrator::develop::develop;
    use crate::integrator::render::{Contact, Ended, Job, Rendered, begin, go_on};
    use crate::scene::load::parse;
    use crate::scene::world::World;

    const SCENE: &str = r#"
format = 1
[film.rgb]
size = [70, 50]
spp = 40
[picture]
alpha = true
[camera.perspective]
position_m = [0, -3, 1]
look_at_m = [0, 0, 0]
vertical_fov_deg = 40
[meshes.ball.sphere]
radius_m = 0.7
[materials.grey.diffuse]
reflectance = 0.5
[objects.ball]
mesh = "ball"
material = "grey"
[lights.sky.constant]
radiance_w_m2_sr_nm = 0.4
"#;

    struct Stage {
        world: World,
        heading: Heading,
        layout: Layout,
    }

    impl Stage {
        fn new() -> Self {
            let loaded = parse(SCENE, "stage.toml", Path::new("."), &[]);
            let scene = loaded.expect("the scene is right").description;
            let world = World::build(&scene).expect("a ball");
            let heading = Heading {
                program: PROGRAM.to_owned(),
                scene: 7,
                job: Job {
                    width: 70,
                    height: 50,
                    spp: 40,
                    seed: 3,
                },
                whole: None,
                aim: None,
                caption: Caption::of(&scene, &world.view, &world.light_colours),
            };
            let layout = Layout::new(&world.wavelengths);
            Self {
                world,
                heading,
                layout,
            }
        }

        /// All samples, with looks at the picture; `on_show` is called after each.
        fn render(&self, preview: &Preview<'_>, on_show: &(dyn Fn() + Sync)) -> Begun {
            let job = &self.heading.job;
            let go = AtomicBool::new(false);
            let begun = begin(&self.world, job, None, &go).expect("a small film");
            let contact = Contact {
                stop: &go,
                progress: &|_| (),
                is_due: &|| preview.is_due(),
                keep: &|begun| {
                    preview.show(begun);
                    on_show();
                },
            };
            let (begun, ended) = go_on(&self.world, job, begun, None, &contact);
            assert_eq!(ended, Ended::Samples);
            begun
        }

        fn preview<'a>(&'a self, shown: Option<&'a Path>, viewer: Option<Viewer>) -> Preview<'a> {
            let preview = Preview::new(&self.heading, self.layout, Duration::ZERO, shown, viewer);
            preview.state().pace.shortest = Duration::from_millis(2);
            preview
        }
    }

    #[test]
    fn looks_at_a_picture_change_none_of_its_bits() {
        let stage = Stage::new();
        let unseen = stage.render(&stage.preview(None, None), &|| ());
        let folder = tempfile::tempdir().expect("a place for temporary files");
        let path = folder.path().join("shown.png");
        let listener = TcpListener::bind("127.0.0.1:0").expect("a free port");
        let address = listener.local_addr().expect("it is bound").to_string();
        let there = std::thread::spawn(move || {
            let (stream, _) = listener.accept().expect("a connection");
            received(stream)
        });
        let viewer = Viewer::open(&address, "stage", [70, 50]).expect("it listens");
        let preview = stage.preview(Some(&path), Some(viewer));
        let seen_often = stage.render(&preview, &|| {
            if preview.state().count == 0 {
                return;
            }
            // Every one is a whole PNG of the picture's size.
            let bytes = std::fs::read(&path).expect("it was just written");
            let size = image::load_from_memory(&bytes).expect("a PNG");
            assert_eq!((size.width(), size.height()), (70, 50));
        });
        assert_eq!(seen_often.film, unseen.film);
        let looks = preview.state().count;
        assert!(looks > 0, "nobody looked");
        preview.show_last(&seen_often.film);
        drop(preview);
        // What the viewer has in the end is the radiance of the picture.
        let rendered = Rendered::new(seen_often, stage.layout, Ended::Samples);
        let picture = develop(&stage.heading.caption, &stage.heading.job, &rendered);
        let channel = |name: &str| picture.layer(name).map(|Layer { data, .. }| data.clone());
        let [red, green, blue] = ["R", "G", "B"].map(|name| channel(name).expect("a colour"));
        let expected: Vec<f32> = (0..red.len())
            .flat_map(|pixel| [red[pixel], green[pixel], blue[pixel]])
            .collect();
        let (name, size, data) = there.join().expect("no panic");
        assert_eq!((name.as_str(), size), ("stage", [70, 50]));
        assert_eq!(data, expected);
    }

    #[test]
    fn a_render_goes_on_when_the_viewer_is_gone_and_the_folder_too() {
        let stage = Stage::new();
        let unseen = stage.render(&stage.preview(None, None), &|| ());
        let listener = TcpListener::bind("127.0.0.1:0").expect("a free port");
        let address = listener.local_addr().expect("it is bound").to_string();
        let viewer = Viewer::open(&address, "stage", [70, 50]).expect("it listens");
        let (stream, _) = listener.accept().expect("a connection");
        drop((stream, listener));
        let missing = Path::new("no/such/folder/shown.png");
        let preview = stage.preview(Some(missing), Some(viewer));
        let begun = stage.render(&preview, &|| ());
        // The system may take some packets before it notices.
        for _ in 0..100 {
            preview.show_last(&begun.film);
        }
        assert_eq!(begun.film, unseen.film);
        let state = preview.state();
        assert!(state.viewer.is_none() && state.has_warned);
    }

    #[test]
    fn a_look_before_the_first_sample_leaves_time_for_samples() {
        let stage = Stage::new();
        let shown = Path::new("no/such/folder/shown.png");
        let preview = stage.preview(Some(shown), None);
        preview.state().pace.shortest = Duration::from_secs(60);
        preview.state().pace.last -= Duration::from_secs(61);
        assert!(preview.is_due());
        let go = AtomicBool::new(false);
        let begun = begin(&stage.world, &stage.heading.job, None, &go);
        preview.show(&begun.expect("a small film"));
        assert!(!preview.is_due());
        assert_eq!(preview.state().count, 0, "there is nothing to see");
    }

    #[test]
    fn nothing_is_due_if_nobody_looks() {
        assert!(!Stage::new().preview(None, None).is_due());
    }
}
