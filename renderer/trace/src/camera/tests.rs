use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::{DVec3, Vec2, Vec3};

use super::thin_lens::{Field, Focus, Iris, Lens, LensError, Opening, ThinLens, lens_axes};
use super::view::{Near, Projection, View};
use super::*;

/// A view along +y from the origin, x to the right and z up.
fn view(projection: Projection) -> View {
    View {
        position: DVec3::ZERO,
        look_at: DVec3::Y,
        up: DVec3::Z,
        projection,
        near: Near::default(),
    }
}

/// 100 mm, f/2, a frame of 24 mm.
fn tele() -> Lens {
    Lens {
        field: Field::FocalLength(0.1),
        opening: Opening::FNumber(2.0),
        ..Lens::pinhole(1.0)
    }
}

fn camera(lens: &Lens, focus: Focus) -> (Camera, ThinLens) {
    let thin = lens.focused(focus).expect("it can be focused");
    let view = view(Projection::Perspective(thin.clone()));
    (Camera::new(&view, 300, 200), thin)
}

/// `side²` points of the unit square, evenly spread: a lattice by the golden ratio, whose columns
/// fall on no border of a polygon's parts.
fn points(side: u32) -> impl Iterator<Item = Vec2> {
    let count = f64::from(side * side);
    (0..side * side).map(move |i| {
        let along = (f64::from(i) * 0.618_033_988_749_894_9).fract();
        Vec2::new(along as f32, ((f64::from(i) + 0.5) / count) as f32)
    })
}

/// Where the ray is when it is at this place along the axis.
fn at_depth(ray: &Ray, y: f64) -> DVec3 {
    let (origin, direction) = (ray.origin().as_dvec3(), ray.direction().as_dvec3());
    origin + direction * ((y - origin.y) / direction.y)
}

#[test]
fn right_is_right_and_up_is_up() {
    let (camera, _) = camera(&Lens::pinhole(FRAC_PI_2), Focus::Distance(2.0));
    let ray = camera.ray(Vec2::new(300.0, 0.0), Vec2::ZERO).ray;
    let expected = Vec3::new(1.5, 1.0, 1.0).normalize();
    assert!(
        (ray.direction() - expected).length() < 1e-6,
        "{}",
        ray.direction()
    );
}

#[test]
fn every_ray_of_a_pixel_meets_in_the_sharp_plane() {
    for blades in [0, 5] {
        let mut lens = tele();
        lens.iris.blades = blades;
        let (camera, _) = camera(&lens, Focus::Distance(2.0));
        let film = Vec2::new(33.0, 171.0);
        let first = at_depth(&camera.ray(film, Vec2::new(0.1, 0.9)).ray, 2.0);
        for lens in points(5) {
            let here = at_depth(&camera.ray(film, lens).ray, 2.0);
            assert!((here - first).length() < 1e-6);
        }
    }
}

#[test]
fn the_thin_lens_law_sets_film_angle_and_opening() {
    // f = 100 mm at 0.3 m: v = f u / (u − f) = 150 mm, and the magnification is v/u = 1/2.
    for focus in [
        Focus::Distance(0.3),
        Focus::Magnification(0.5),
        Focus::Point(DVec3::new(0.02, -0.05, 0.3)),
    ] {
        let thin = tele().focused(focus).expect("it is farther than f");
        assert!((thin.focus_distance - 0.3).abs() < 1e-12, "{thin:?}");
        assert!((thin.image_distance - 0.15).abs() < 1e-12, "{thin:?}");
        assert!((thin.focal_length() - 0.1).abs() < 1e-12, "{thin:?}");
        let half = 0.5 * thin.vertical_fov;
        assert!((libm::tan(half) - 0.012 / 0.15).abs() < 1e-12, "{thin:?}");
        assert!((thin.radius - 0.025).abs() < 1e-12, "{thin:?}");
    }
    // At infinity the angle is the nominal one.
    let far = tele().focused(Focus::Infinity).expect("it is far");
    assert!((libm::tan(0.5 * far.vertical_fov) - 0.12).abs() < 1e-12);
    // An angle gives the film's distance, and both distances the focal length.
    let lens = Lens {
        field: Field::Angle(2.0 * libm::atan(0.08)),
        ..tele()
    };
    let thin = lens.focused(Focus::Distance(0.3)).expect("any distance");
    assert!((thin.focal_length() - 0.1).abs() < 1e-12, "{thin:?}");
    assert!((thin.radius - 0.025).abs() < 1e-12, "{thin:?}");
}

#[test]
fn a_point_out_of_focus_becomes_the_circle_of_confusion() {
    // c = A f |z − u| / (z (u − f)) on the film, with the opening's diameter A.
    let (camera, thin) = camera(&tele(), Focus::Distance(0.5));
    let (diameter, f, u) = (2.0 * thin.radius, 0.1, 0.5);
    let pixel = 0.024 / 200.0;
    for z in [0.3_f64, 0.45, 0.6, 2.0, 50.0] {
        let confusion = diameter * f * (z - u).abs() / (z * (u - f));
        // The farthest film points, up and down, whose rays meet the point on the axis: by
        // bisection over the film, for the uppermost and lowest point of the lens.
        let meets = |lens: Vec2| {
            let (mut low, mut high) = (-3000.0_f32, 3000.0_f32);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                let ray = camera.ray(Vec2::new(150.0, middle), lens).ray;
                if at_depth(&ray, z).z > 0.0 {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            f64::from(low)
        };
        // The disc's warp takes these to its top and bottom.
        let [top, bottom] = [Vec2::new(0.5, 1.0), Vec2::new(0.5, 0.0)].map(meets);
        let found = (top - bottom).abs() * pixel;
        assert!(
            (found / confusion - 1.0).abs() < 2e-4,
            "{found} is not {confusion} at {z}"
        );
    }
}

#[test]
fn a_tilted_lens_is_sharp_on_a_plane_that_meets_lens_and_film_in_one_line() {
    for (tilt, focus) in [
        ([-0.1, 0.0], Focus::Distance(0.5)),
        ([0.05, 0.2], Focus::Distance(0.4)),
        ([0.3, -0.2], Focus::Magnification(0.5)),
        ([-0.2, 0.1], Focus::Point(DVec3::new(0.02, -0.03, 0.4))),
    ] {
        for field in [Field::FocalLength(0.1), Field::Angle(0.2)] {
            if matches!((field, focus), (Field::Angle(_), Focus::Magnification(_))) {
                continue;
            }
            let lens = Lens {
                field,
                tilt,
                ..tele()
            };
            let (camera, thin) = camera(&lens, focus);
            let normal = lens_axes(tilt).z_axis;
            let (f, v) = (thin.focal_length(), thin.image_distance);
            if let Field::FocalLength(length) = field {
                assert!((f - length).abs() < 1e-12);
            }
            // The plane that the thin-lens law predicts: a·P = 1.
            let plane = normal / f - DVec3::Z / v;
            if let Focus::Point(point) = focus {
                assert!((plane.dot(point) - 1.0).abs() < 1e-9, "{plane}");
            }
            // All rays of a film point meet there.
            for film in [(150.0, 100.0), (10.0, 20.0), (280.0, 150.0)] {
                let film = Vec2::new(film.0, film.1);
                let meeting = |lens: Vec2| {
                    let FilmRay { ray, weight } = camera.ray(film, lens);
                    assert_eq!(weight, 1.0);
                    // From the world (right x, into y, up z) to the frame of the picture.
                    let swap = |v: Vec3| DVec3::new(v.x.into(), v.z.into(), v.y.into());
                    let (origin, direction) = (swap(ray.origin()), swap(ray.direction()));
                    assert!(normal.dot(origin).abs() < 1e-8, "rays start on the lens");
                    origin + direction * ((1.0 - plane.dot(origin)) / plane.dot(direction))
                };
                let first = meeting(Vec2::new(0.5, 0.5));
                for lens in points(4) {
                    let here = meeting(lens);
                    assert!(
                        (here - first).length() < 3e-6 * first.length(),
                        "{here} {first}"
                    );
                }
                // The film point, seen through the lens by the law of images: the same point.
                let film_point = -first * (v / first.z);
                let (object, image) = (normal.dot(first), -normal.dot(film_point));
                assert!((1.0 / object + 1.0 / image - 1.0 / f).abs() < 1e-4 / f);
            }
            // Scheimpflug: points of the lens's plane (n·P = 0) and of the film's (z = −v) lie in
            // the sharp plane.
            let line = normal.cross(DVec3::Z).normalize();
            let in_film = normal - DVec3::Z * normal.z;
            let start = in_film * (v * normal.z / in_film.length_squared()) - DVec3::Z * v;
            for along in [-1.0, 0.0, 2.0] {
                let point = start + line * along;
                assert!(normal.dot(point).abs() < 1e-9, "not in the lens's plane");
                assert!(
                    (plane.dot(point) - 1.0).abs() < 1e-9,
                    "not in the sharp plane"
                );
            }
        }
    }
}

#[test]
fn a_lens_that_leans_forward_lays_the_sharp_plane_down() {
    let lens = Lens {
        tilt: [-0.1, 0.0],
        ..tele()
    };
    let (camera, _) = camera(&lens, Focus::Distance(0.5));
    // Where the rays of a film point above and one below the middle meet.
    let depth = |y: f32| {
        let ends = [Vec2::new(0.5, 1.0), Vec2::new(0.5, 0.0)].map(|lens| {
            let ray = camera.ray(Vec2::new(150.0, y), lens).ray;
            let slope = f64::from(ray.direction().z / ray.direction().y);
            (
                f64::from(ray.origin().z) - f64::from(ray.origin().y) * slope,
                slope,
            )
        });
        (ends[1].0 - ends[0].0) / (ends[0].1 - ends[1].1)
    };
    assert!(
        depth(20.0) > 0.51 && depth(180.0) < 0.49,
        "{} {}",
        depth(20.0),
        depth(180.0)
    );
}

#[test]
fn polygons_have_the_area_of_the_disc_and_are_covered_evenly() {
    for (blades, rotation) in [(3, 0.0), (5, 0.3), (8, -1.0), (32, 0.1)] {
        let mut lens = tele();
        lens.iris = Iris {
            blades,
            rotation,
            cats_eye: 0.0,
        };
        let (camera, thin) = camera(&lens, Focus::Distance(2.0));
        let n = f64::from(blades);
        // A regular polygon with corners at distance ρ has the area n/2 ρ² sin(2π/n).
        let around = thin.radius * (TAU / n / libm::sin(TAU / n)).sqrt();
        let inner = around * libm::cos(PI / n);
        let area = 0.5 * n * around * around * libm::sin(TAU / n);
        assert!((area / (PI * thin.radius * thin.radius) - 1.0).abs() < 1e-12);
        let mut within = [0_u32; 3];
        let mut highest = f64::NEG_INFINITY;
        let side = 400;
        let turned = rotation + FRAC_PI_2;
        for lens in points(side) {
            let origin = camera.ray(Vec2::new(150.0, 100.0), lens).ray.origin();
            let (x, y) = (f64::from(origin.x), f64::from(origin.z));
            // Distance from the nearest blade's middle, in the polygon's own frame.
            let angle = (libm::atan2(y, x) - turned).rem_euclid(TAU / n) - PI / n;
            let distance = x.hypot(y) * libm::cos(angle);
            assert!(
                distance <= inner * (1.0 + 1e-5),
                "{distance} outside {inner}"
            );
            highest = highest.max(x * libm::cos(turned) + y * libm::sin(turned));
            // Shares of area: a polygon half as large, one half, one side of a corner's line.
            within[0] += u32::from(distance < 0.5 * inner);
            within[1] += u32::from(distance < inner * 0.5_f64.sqrt());
            within[2] += u32::from(y * libm::cos(turned) - x * libm::sin(turned) > 0.0);
        }
        let shares = within.map(|count| f64::from(count) / f64::from(side * side));
        for (share, expected) in shares.into_iter().zip([0.25, 0.5, 0.5]) {
            assert!((share - expected).abs() < 4e-3, "{blades}: {shares:?}");
        }
        assert!(
            (highest / around - 1.0).abs() < 0.01,
            "a corner is on top: {highest} {around}"
        );
    }
}

#[test]
fn the_cats_eye_has_the_area_of_two_discs_overlap() {
    // Of two equal discs 2 q ρ apart this share of each overlaps: 2/π (acos q − q √(1 − q²)).
    for cats_eye in [0.3, 0.7, 1.0] {
        let mut lens = tele();
        lens.iris.cats_eye = cats_eye;
        let (camera, _) = camera(&lens, Focus::Distance(2.0));
        // From the middle to the upper right corner.
        for share in [0.0, 0.5, 0.8, 1.0] {
            let film = Vec2::new(150.0 + 150.0 * share, 100.0 - 100.0 * share);
            let side = 400;
            let open = points(side).filter(|lens| camera.ray(film, *lens).weight > 0.0);
            let found = open.count() as f64 / f64::from(side * side);
            let q = cats_eye * f64::from(share);
            let expected = 2.0 / PI * (libm::acos(q) - q * (1.0 - q * q).sqrt());
            assert!(
                (found - expected).abs() < 3e-3,
                "{found} is not {expected} at {q}"
            );
        }
    }
}

#[test]
fn the_cats_eye_keeps_what_the_rim_before_the_lens_lets_through() {
    let mut lens = tele();
    lens.iris.cats_eye = 0.5;
    let (camera, _) = camera(&lens, Focus::Distance(2.0));
    // At the right edge rays go to the right, so the rim is in the way of those from the right.
    let film = Vec2::new(300.0, 100.0);
    assert_eq!(camera.ray(film, Vec2::new(0.99, 0.5)).weight, 0.0);
    assert_eq!(camera.ray(film, Vec2::new(0.01, 0.5)).weight, 1.0);
}

#[test]
fn orthographic_rays_are_parallel_and_start_as_far_apart_as_they_end() {
    let camera = Camera::new(&view(Projection::Orthographic { height: 0.2 }), 300, 200);
    let corners = [(0.0, 0.0), (300.0, 0.0), (0.0, 200.0), (300.0, 200.0)];
    for (x, y) in corners {
        let ray = camera.ray(Vec2::new(x, y), Vec2::new(0.3, 0.9)).ray;
        assert_eq!(ray.direction(), Vec3::Y);
        let expected = Vec3::new(x / 1000.0 - 0.15, 0.0, 0.1 - y / 1000.0);
        assert!(
            (ray.origin() - expected).length() < 1e-7,
            "{}",
            ray.origin()
        );
    }
    assert_eq!(camera.pixel_span(), [0.001, 0.0]);
    assert!(!camera.has_lens());
    let aside = DVec3::new(3.0, 4.0, 0.0);
    assert_eq!(
        view(Projection::Orthographic { height: 0.2 }).distance_of(aside),
        4.0
    );
    let lens = tele().focused(Focus::Infinity).expect("it is far");
    assert_eq!(view(Projection::Perspective(lens)).distance_of(aside), 5.0);
}

#[test]
fn what_cannot_be_sharp_is_refused() {
    let at = |lens: &Lens, focus| lens.focused(focus).expect_err("it cannot be sharp");
    let near = at(&tele(), Focus::Distance(0.1));
    assert!(matches!(near, LensError::TooNear { .. }), "{near}");
    let behind = at(&tele(), Focus::Point(DVec3::new(0.0, 0.0, -1.0)));
    assert_eq!(behind, LensError::Behind { behind: 1.0 });
    let leaning = Lens {
        tilt: [-0.7, 0.0],
        ..tele()
    };
    // The plane through a point far below the axis never comes up to it.
    let off = at(&leaning, Focus::Point(DVec3::new(0.0, -3.0, 1.0)));
    assert!(
        matches!(off, LensError::OffAxis | LensError::TooNear { .. }),
        "{off}"
    );
    let wide = Lens {
        field: Field::FocalLength(0.0005),
        ..tele()
    };
    assert!(matches!(
        at(&wide, Focus::Infinity),
        LensError::Angle { .. }
    ));
    let no = at(&Lens::pinhole(1.0), Focus::Magnification(1.0));
    assert_eq!(no, LensError::NoFocalLength);
}
