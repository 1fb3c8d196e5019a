//! A view as bytes.

use super::bytes::{Out, Rest};
use crate::camera::thin_lens::{Iris, ThinLens};
use crate::camera::view::{Near, Projection, View};

pub(super) fn put(view: &View, out: &mut Out) {
    let View {
        position,
        look_at,
        up,
        projection,
        near: Near { origin, distance },
    } = view;
    for point in [position, look_at, up, origin] {
        out.doubles(&point.to_array());
    }
    match projection {
        Projection::Perspective(lens) => {
            out.flag(false);
            let ThinLens {
                vertical_fov,
                image_distance,
                focus_distance,
                radius,
                iris,
                tilt,
            } = lens;
            out.doubles(&[*vertical_fov, *image_distance, *focus_distance, *radius]);
            out.word(iris.blades);
            out.doubles(&[iris.rotation, iris.cats_eye]);
            out.doubles(tilt);
        }
        Projection::Orthographic { height } => {
            out.flag(true);
            out.double(*height);
        }
    }
    out.double(*distance);
}

pub(super) fn take(rest: &mut Rest<'_>) -> Option<View> {
    let [position, look_at, up, origin] = [
        rest.doubles()?.into(),
        rest.doubles()?.into(),
        rest.doubles()?.into(),
        rest.doubles()?.into(),
    ];
    Some(View {
        position,
        look_at,
        up,
        projection: if rest.flag()? {
            Projection::Orthographic {
                height: rest.double()?,
            }
        } else {
            Projection::Perspective(ThinLens {
                vertical_fov: rest.double()?,
                image_distance: rest.double()?,
                focus_distance: rest.double()?,
                radius: rest.double()?,
                iris: Iris {
                    blades: rest.word()?,
                    rotation: rest.double()?,
                    cats_eye: rest.double()?,
                },
                tilt: rest.doubles()?,
            })
        },
        near: Near {
            origin,
            distance: rest.double()?,
        },
    })
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::camera::thin_lens::{Field, Focus, Lens, Opening};

    #[test]
    fn a_view_comes_back_as_it_was() {
        let lens = Lens {
            field: Field::FocalLength(0.06),
            sensor_height: 0.033,
            opening: Opening::FNumber(3.5),
            iris: Iris {
                blades: 7,
                rotation: 0.2,
                cats_eye: 0.4,
            },
            tilt: [0.1, -0.2],
        };
        let lens = lens.focused(Focus::Magnification(0.7)).expect("a macro");
        for projection in [
            Projection::Perspective(lens),
            Projection::Orthographic { height: 0.3 },
        ] {
            let view = View {
                position: DVec3::new(1.0, 2.0, 3.0),
                look_at: DVec3::new(4.0, 5.0, 6.0),
                up: DVec3::new(7.0, 8.0, 9.0),
                projection,
                near: Near {
                    origin: DVec3::new(10.0, 11.0, 12.0),
                    distance: 13.0,
                },
            };
            let mut out = Out::default();
            put(&view, &mut out);
            let mut rest = Rest(&out.0);
            assert_eq!(take(&mut rest), Some(view));
            assert!(rest.0.is_empty());
            for shorter in 0..out.0.len() {
                assert_eq!(take(&mut Rest(&out.0[..shorter])), None);
            }
        }
    }
}
