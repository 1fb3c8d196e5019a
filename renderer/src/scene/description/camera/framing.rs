//! Framing: where a camera stands so that something fills its picture.

use glam::{DMat3, DVec3};

use crate::camera::thin_lens::{Field, Focus, Lens, LensError, ThinLens};
use crate::camera::view::{Projection, View};

/// What fills the picture: the camera stays in its direction and goes as near as that allows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    /// Index into [`crate::scene::description::Description::objects`]; everything if it is `None`.
    pub(super) object: Option<usize>,
    /// Fraction of the picture's width and height that is left free at each edge.
    pub(super) margin: f64,
}

/// Points that fill a picture, and how far they go along the axes of a view, from the scene's origin.
#[derive(Clone, Debug)]
pub(super) struct Framed {
    /// The points along those axes.
    points: Vec<DVec3>,
    axes: DMat3,
    least: DVec3,
    most: DVec3,
    /// Width of the picture over its height.
    aspect: f64,
    /// As in [`Frame::margin`].
    margin: f64,
}

/// Relative error of a framing: far below a pixel.
const PRECISION: f64 = 1e-9;

/// Most rounds of a framing; it mostly takes three to six.
const ROUNDS: u32 = 100;

impl Framed {
    /// None if there are no points.
    pub(super) fn of(
        mut points: Vec<DVec3>,
        view: &View,
        aspect: f64,
        margin: f64,
    ) -> Option<Self> {
        let axes = view.axes();
        for point in &mut points {
            *point = axes.transpose() * *point;
        }
        let least = points.iter().copied().reduce(DVec3::min)?;
        let most = points.iter().copied().reduce(DVec3::max)?;
        Some(Self {
            points,
            axes,
            least,
            most,
            aspect,
            margin,
        })
    }

    /// Lets the picture of parallel rays show all of it.
    pub(super) fn fill_by_parallel_rays(&self, view: &mut View) {
        let size = (self.most - self.least) / (1.0 - 2.0 * self.margin);
        let middle = 0.5 * (self.least + self.most);
        // Rays start before all of it.
        let before = self.most.z - self.least.z + size.x.max(size.y);
        let position = DVec3::new(middle.x, middle.y, self.least.z - before);
        view.position = self.axes * position;
        view.look_at = self.axes * middle;
        view.projection = Projection::Orthographic {
            height: size.y.max(size.x / self.aspect),
        };
    }

    /// Lets the picture of a lens show all of it. `focus` finds what is sharp for a view and the distance of the middle
    /// of the points along its axis; `at_first` is that for a view from infinitely far away.
    ///
    /// With a focal length F the angle of view depends on the focus, and that on where the camera stands: half the
    /// picture is t = H (1/F − 1/u) times as high as far, with half the sensor's height H and the distance u of what is
    /// sharp. The less t the camera stands for, the farther it stands, and the greater is t: they meet at one place
    /// between 0 and the t of what is infinitely far away. As u is nearly in proportion to 1/t, each round tells the next.
    ///
    /// # Errors
    ///
    /// [`LensError`] if the lens cannot be focused.
    pub(super) fn fill_by_lens(
        &self,
        view: &mut View,
        lens: &Lens,
        at_first: Focus,
        focus: impl Fn(&View, f64) -> Focus,
    ) -> Result<(), LensError> {
        let slope = |lens: &ThinLens| libm::tan(0.5 * lens.vertical_fov);
        let greatest = slope(&lens.focused(at_first)?);
        let [mut least, mut most] = [0.0, greatest];
        let mut stands = greatest;
        let mut last = Ok(());
        for _ in 0..ROUNDS {
            let middle = self.fill(view, stands);
            let seen = match lens.focused(focus(view, middle)) {
                Ok(thin) => {
                    let seen = slope(&thin);
                    view.projection = Projection::Perspective(thin);
                    last = Ok(());
                    seen
                }
                // A camera that stands farther away has it in front of its lens.
                Err(error @ (LensError::TooNear { .. } | LensError::Behind { .. }))
                    if matches!(lens.field, Field::FocalLength(_)) =>
                {
                    last = Err(error);
                    0.0
                }
                Err(error) => return Err(error),
            };
            if (seen - stands).abs() <= PRECISION * stands {
                break;
            }
            if seen < stands {
                most = stands;
            } else {
                least = stands;
            }
            stands *= greatest / (stands + greatest - seen);
            if last.is_err() || !(least..most).contains(&stands) {
                stands = 0.5 * (least + most);
            }
        }
        last
    }

    /// Moves a camera to the nearest place from which all points are in the picture, in its middle, and returns the
    /// distance of the middle of them along its axis. `slope` is half the picture's height over the distance.
    ///
    /// A point (x, y, z) is in the picture of a camera at (a, b, c) if |x − a| ≤ t (z − c) and |y − b| ≤ s (z − c): the
    /// greatest x − t z and −x − t z over all points decide a and the greatest c, and so do those of y.
    fn fill(&self, view: &mut View, slope: f64) -> f64 {
        let half = slope * (1.0 - 2.0 * self.margin);
        let slopes = [half * self.aspect, half];
        let mut greatest = [[f64::NEG_INFINITY; 2]; 2];
        for point in &self.points {
            for (axis, at) in [point.x, point.y].into_iter().enumerate() {
                let [right, left] = &mut greatest[axis];
                *right = right.max(at - slopes[axis] * point.z);
                *left = left.max(-at - slopes[axis] * point.z);
            }
        }
        let place = [0, 1].map(|axis| 0.5 * (greatest[axis][0] - greatest[axis][1]));
        let depth =
            [0, 1].map(|axis| -0.5 * (greatest[axis][0] + greatest[axis][1]) / slopes[axis]);
        let depth = depth[0].min(depth[1]);
        let middle = 0.5 * (self.least.z + self.most.z) - depth;
        view.position = self.axes * DVec3::new(place[0], place[1], depth);
        view.look_at = view.position + self.axes.z_axis * middle;
        middle
    }
}
