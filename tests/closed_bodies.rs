//! Smooth bodies are closed: no light passes them because their normals are interpolated, and none
//! is lost.

use glam::{Vec2, Vec3};
use renderer::bsdf::coat_table::{Bloom, CoatTable};
use renderer::bsdf::dielectric::Dielectric;
use renderer::bsdf::leaf::{Coat, LeafBsdf, LeafShape, Tissue};
use renderer::bsdf::metallic_roughness::MetallicRoughness;
use renderer::bsdf::{Bsdf, View};
use renderer::geometry::frame::Frame;
use renderer::geometry::{Ray, SurfacePoint};
use renderer::sampling::stream::Stream;
use renderer::spectrum::Lanes;
use renderer::walk::facet::{self, Facet, Surroundings};
use support::chi_square::{ChiSquare, sidak};
use support::picture::{mean_of, means_and_errors, picture_of};

/// The head of a scene with a camera at a place that looks at another, and so many samples.
fn head(place: [f64; 3], towards: [f64; 3], fov_deg: f64, spp: u32) -> String {
    format!(
        "format = 1\n\
         [film.spectral]\nsize = [12, 12]\nspp = {spp}\nbands_nm = [550]\nband_width_nm = 0\n\
         [camera.perspective]\nposition_m = {place:?}\nlook_at_m = {towards:?}\n\
         up = [0.1, 0.2, 1]\nvertical_fov_deg = {fov_deg}\n"
    )
}

/// Paths that end after some events, and lose nothing before.
const SHORT: &str = "[integrator]\nmax_depth = 12\nroulette_below = 0\n";

/// What surrounds everything: a sky of radiance 1.
const SKY: &str = "[lights.sky.constant]\nradiance_w_m2_sr_nm = 1\n";

/// A sky, a sun and a lamp, all outside of a body around the origin.
const LIGHTS: &str = "
[lights.sky.constant]
radiance_w_m2_sr_nm = 1
[lights.sun.distant]
irradiance_w_m2_nm = 100
elevation_deg = 40
azimuth_deg = 30
[lights.lamp.spot]
intensity_w_sr_nm = 100
position_m = [3, -2, 1]
look_at_m = [0, 0, 0]
cone_angle_deg = 60
[meshes.panel.rectangle]
width_m = 1
height_m = 1
[materials.black.diffuse]
reflectance = 0
[objects.panel]
mesh = \"panel\"
material = \"black\"
position_m = [0, 0, -3]
[lights.panel.area]
object = \"panel\"
radiance_w_m2_sr_nm = 50
";

/// Materials that let nothing through, each called `skin`.
const OPAQUE: [(&str, &str); 5] = [
    ("diffuse", "[materials.skin.diffuse]\nreflectance = 1\n"),
    (
        "plastic",
        "[materials.skin.plastic]\nreflectance = 1\nroughness = 0.3\n",
    ),
    (
        "glossy plastic",
        "[materials.skin.plastic]\nreflectance = 0.5\nroughness = 0.02\n",
    ),
    (
        "measured leaf",
        "[materials.skin.leaf]\nadaxial = { eta = 1.45, alpha = 0.2 }\n\
         [materials.skin.leaf.measured]\nreflectance = 0.9\ntransmittance = 0\n",
    ),
    (
        "solid tissue",
        "[materials.skin.solid]\n[materials.skin.solid.contents]\n\
         carotenoids_ug_per_cm2 = 0\n",
    ),
];

/// Leaves that absorb nothing, called `skin`: without coats, of layers, and with coats.
const BARE: &str = "[materials.skin.leaf]\nabaxial_ratio = 1\n\
    adaxial = { eta = 1, alpha = 0.3 }\nabaxial = { eta = 1, alpha = 0.3 }\n\
    [materials.skin.leaf.measured]\nreflectance = 0.6\ntransmittance = 0.4\n";
const LAYERS: &str = "[materials.skin.leaf]\noptics = \"layers\"\n\
    [materials.skin.leaf.contents]\nstructure = 1.5\nchlorophyll_ug_per_cm2 = 0\n\
    carotenoids_ug_per_cm2 = 0\nwater_cm = 1e-4\ndry_matter_g_per_cm2 = 0\n";
const LOSSLESS: &str = "[materials.skin.leaf]\nabaxial_ratio = 1\n\
    adaxial = { eta = 1.45, alpha = 0.15 }\nabaxial = { eta = 1.4, alpha = 0.4 }\n\
    [materials.skin.leaf.measured]\nreflectance = 0.6\ntransmittance = 0.4\n";

fn sphere(segments: u32) -> String {
    format!("[meshes.thing.sphere]\nradius_m = 1\nsegments = {segments}\n")
}

const LUMP: &str = "[meshes.thing.lump]\nradius_m = 1\nsegments = 16\nseed = 3\n";

const THING: &str = "[objects.thing]\nmesh = \"thing\"\nmaterial = \"skin\"\n";

/// A fruit of tissue that absorbs nothing at 550 nm.
const FRUIT: &str = "
[solids.fruit]
[solids.fruit.shape.lathe]
profile_mm = [[0, 7], [14, 1], [33, 6], [43, 24], [41, 44], [27, 60], [12, 65], [5, 62], [0, 58]]
[solids.fruit.contents]
carotenoids_ug_per_cm2 = 0
[objects.fruit]
solid = \"fruit\"
";

/// A closed blade, bent and coarse, whose leaf absorbs nothing.
const BLADE: &str = "
[leaves.close]
length_mm = 50
seed = 11
map_size = 100
[leaves.close.outline.growth_algorithm]
rate_ratio = 1.22
widest_at = 0.32
falloff = 3
veins = [[0.1, -0.35], [0.9, 0.45]]
[leaves.close.venation.closed]
final_length_segments = 60
kill_distance_segments = 1
birth_distance_segments = 3.5
darts_per_segment2 = 0.01
murray_exponent = 2.3
veinlet_radius_mm = 0.03
[leaves.close.venation.closed.growth.isogonic]
initial_length_segments = 20
length_step_segments = 1.5
[leaves.close.contents]
structure = 1.5
chlorophyll_ug_per_cm2 = 0
carotenoids_ug_per_cm2 = 0
water_cm = 0
dry_matter_g_per_cm2 = 0
[leaves.close.blade]
closed = true
thickness_mm = 2
fold_deg = 30
curl_deg = 100
max_edge_mm = 8
[leaves.close.adaxial]
eta = 1
alpha = 0.3
[leaves.close.abaxial]
eta = 1
alpha = 0.3
[objects.leaf]
leaf = \"close\"
";

#[test]
fn no_light_gets_into_an_opaque_body_of_any_material() {
    for mesh in [sphere(8), sphere(16), sphere(64), LUMP.to_owned()] {
        for (name, material) in OPAQUE {
            let text = head([0.3, 0.01, 0.02], [1.0, 0.0, 0.0], 60.0, 64)
                + SHORT
                + material
                + &mesh
                + THING
                + LIGHTS;
            let inside = mean_of(&picture_of(&text, 1), 0);
            assert_eq!(inside, 0.0, "{name}: {mesh}");
        }
    }
    let text = head([0.0, 0.0, 0.03], [1.0, 0.0, 0.03], 100.0, 64) + SHORT + FRUIT + LIGHTS;
    assert_eq!(mean_of(&picture_of(&text, 1), 0), 0.0, "a fruit");
}

/// What a lossless leaf with coats may lose in some five events: one is right within 3e-4, as its
/// coat's albedo is tabulated.
const BY_COATS: f64 = 1.5e-3;

/// Asserts that a furnace of radiance 1 is seen as such.
fn assert_furnace(what: &str, text: &str, allowed: f64) {
    let [(mean, error)] = means_and_errors(text, 6);
    eprintln!("{what}: {mean:.6} ± {error:.1e}");
    assert!(error < 1e-3, "{what}: {error}");
    assert!(
        (mean - 1.0).abs() < 4.0 * error + allowed,
        "{what}: {mean} ± {error}"
    );
}

#[test]
fn a_white_furnace_shows_no_smooth_body_from_outside() {
    for mesh in [sphere(8), sphere(16), sphere(64), LUMP.to_owned()] {
        for (name, material, allowed) in [
            ("diffuse", OPAQUE[0].1, 1e-5),
            ("bare leaf", BARE, 1e-5),
            ("leaf of layers", LAYERS, 1e-5),
            ("leaf", LOSSLESS, BY_COATS),
        ] {
            let text = head([0.0, -3.5, 0.5], [0.0; 3], 34.0, 64) + material + &mesh + THING + SKY;
            assert_furnace(&format!("{name}: {mesh}"), &text, allowed);
        }
    }
    let text = head([0.0, -0.25, 0.08], [0.0, 0.0, 0.03], 28.0, 64) + FRUIT + SKY;
    assert_furnace("a fruit", &text, BY_COATS);
    let text = head([0.0, -0.06, 0.05], [0.0, 0.02, 0.0], 16.0, 64) + BLADE + SKY;
    assert_furnace("a closed blade", &text, 1e-5);
}

#[test]
fn a_white_furnace_is_as_bright_within_a_leaf_around_it() {
    for mesh in [sphere(8), sphere(16), sphere(64), LUMP.to_owned()] {
        for (name, material, allowed) in [
            ("bare leaf", BARE, 1e-5),
            ("leaf of layers", LAYERS, 1e-5),
            ("leaf", LOSSLESS, BY_COATS),
        ] {
            let text = head([0.3, 0.01, 0.02], [1.0, 0.2, 0.1], 100.0, 64)
                + material
                + &mesh
                + THING
                + SKY;
            assert_furnace(&format!("{name}: {mesh}"), &text, allowed);
        }
    }
}

#[test]
fn a_white_furnace_is_as_bright_within_a_closed_blade() {
    // Halfway between the faces, which are 2 mm apart.
    let within = [0.0, 0.0136, -0.0034];
    let coated = BLADE.replace("eta = 1\n", "eta = 1.45\n");
    for (name, blade, allowed) in [("bare", BLADE, 1e-5), ("coated", &coated, BY_COATS)] {
        for up in [1.0, -1.0] {
            let towards = [0.0, 0.0136, up];
            let text = head(within, towards, 120.0, 64) + blade + SKY;
            let what = format!("a {name} closed blade, {up}");
            // From outside the sky would be seen on one side.
            let open = picture_of(&text, 0).film.map(|pixel| pixel.alpha() < 1.0);
            assert!(!open.contains(&true), "{what}");
            assert_furnace(&what, &text, allowed);
        }
    }
}

/// A picture of a sphere of 16 segments from afar by light that is scattered once, and its greatest
/// pixel.
fn lit_sphere(material: &str, sun: &str) -> (Vec<f64>, f64) {
    let text = format!(
        "format = 1\n\
         [film.spectral]\nsize = [{PIXELS}, {PIXELS}]\nspp = 1\nbands_nm = [550]\n\
         band_width_nm = 0\nfilter_radius_px = 0\n\
         [camera.orthographic]\nposition_m = [1, -3, 2]\nlook_at_m = [0, 0, 0]\nheight_m = 2\n\
         [integrator]\nmax_depth = 1\n\
         {material}{}{THING}[lights.sun.distant]\nirradiance_w_m2_nm = 1\n\
         angular_diameter_deg = 0.01\n{sun}\n",
        sphere(16)
    );
    let means = picture_of(&text, 1).film.map(|pixel| pixel.mean(0));
    let most = means.iter().copied().fold(0.0, f64::max);
    (means, most)
}

const PIXELS: usize = 256;

#[test]
fn the_terminator_of_a_coarse_sphere_has_no_steps() {
    for (name, material) in [OPAQUE[0], OPAQUE[1], OPAQUE[3], ("leaf", LOSSLESS)] {
        for azimuth in [-70, -20, 35, 80, 150] {
            for elevation in [-20, 15, 50] {
                let sun = format!("elevation_deg = {elevation}\nazimuth_deg = {azimuth}\n");
                let (means, most) = lit_sphere(material, &sun);
                let mut greatest = 0.0_f64;
                for y in 1..PIXELS {
                    for x in 1..PIXELS {
                        // Towards the outline pixels are ever larger parts of the sphere.
                        let middle = 0.5 * PIXELS as f64;
                        let from_middle = [x, y].map(|at| at as f64 - middle);
                        let [across, up] = from_middle;
                        if across * across + up * up > 0.7 * middle * middle {
                            continue;
                        }
                        let own = means[y * PIXELS + x];
                        for other in [means[y * PIXELS + x - 1], means[(y - 1) * PIXELS + x]] {
                            // Of the lit side, highlights may be steep.
                            if own.min(other) < 0.15 * most {
                                greatest = greatest.max((own - other).abs() / most);
                            }
                        }
                    }
                }
                assert!(
                    greatest < 0.1,
                    "{name}, sun at {azimuth}°, {elevation}°: {greatest:.3} of the lit maximum"
                );
            }
        }
    }
}

/// Whether anything is in the way of light that rises between the planes.
struct Above {
    is_free: bool,
}

impl Surroundings for Above {
    fn is_free(&self, _way: &Ray) -> bool {
        self.is_free
    }
}

/// A place whose shading normal is tilted by an angle.
fn tilted(angle_deg: f32) -> SurfacePoint {
    let (sine, cosine) = libm::sincosf(angle_deg.to_radians());
    SurfacePoint {
        position: Vec3::ZERO,
        position_error: 1e-6,
        geometric_normal: Vec3::Z,
        shading_normal: Vec3::new(sine, 0.0, cosine),
        rise: [0.01, 0.02],
        tangent: Vec3::Y,
        uv: Vec2::ZERO,
        instance: 0,
        triangle: 0,
    }
}

/// Directions to the viewer: plain ones on both sides, and two between the planes.
const VIEWS: [[f32; 3]; 5] = [
    [0.2, 0.3, 0.9],
    [-0.5, 0.1, 0.6],
    [0.3, -0.4, -0.7],
    [-0.95, 0.1, 0.12],
    [0.95, 0.1, -0.12],
];

/// Asserts of a surface with a tilted normal what holds for any BSDF.
fn assert_closed(name: &str, bsdf: &Bsdf<'_, 8>) {
    const CHI_SQUARE: ChiSquare = ChiSquare {
        rings: 18,
        spokes: 36,
        draws: 100_000,
        midpoints: 24,
    };
    let surface = tilted(20.0);
    let frame: Frame = surface.frame();
    for (number, from) in VIEWS.into_iter().enumerate() {
        let from = Vec3::from_array(from).normalize();
        let wo = facet::arriving(&surface, &frame, -from);
        assert_eq!(
            wo.z > 0.0,
            from.z > 0.0,
            "light arrives on the side from which it comes"
        );
        let view = bsdf.seen_from(wo).expect("not from within the plane");
        let seen = (&frame, &view);
        let draw = |draw: usize| {
            let [lobe, x, y, _] = Stream::new(number as u64, draw as u32, 0, 0).next4();
            (lobe, Vec2::new(x, y))
        };
        for is_free in [false, true] {
            let facet = Facet {
                around: &Above { is_free },
                surface: &surface,
            };
            let (mut whole, mut own, mut square) = (0.0, 0.0, 0.0);
            let outcome = CHI_SQUARE.run(
                |index| {
                    let (lobe, u) = draw(index);
                    let plain = view.sample(lobe, u);
                    let weight = |weight: Lanes<8>| f64::from(weight.0[3]);
                    let plain = plain.map_or(0.0, |sample| weight(sample.weight));
                    let found = facet.sample(seen, lobe, u);
                    let folded = found.map_or(0.0, |(_, sample)| weight(sample.weight));
                    own += plain;
                    whole += folded;
                    square += (folded - plain) * (folded - plain);
                    let (wi_world, sample) = found?;
                    let side = |w: Vec3| w.dot(surface.shading_normal) > 0.0;
                    assert_eq!(side(wi_world), sample.wi.z > 0.0);
                    assert!(is_free || !surface.is_between_planes(wi_world), "{name}");
                    let (_, again) = facet.scatter(seen, wi_world);
                    assert!((again.pdf / sample.pdf - 1.0).abs() < 1e-3, "{name}");
                    Some(wi_world)
                },
                |wi_world| facet.scatter(seen, wi_world).1.pdf,
            );
            // What is mirrored or rises is neither lost nor gained.
            let count = CHI_SQUARE.draws as f64;
            let (difference, error) = ((whole - own) / count, square.sqrt() / count);
            assert!(
                difference.abs() < 4.0 * error + 1e-4,
                "{name}, view {number}: {difference} ± {error}"
            );
            let level = sidak(0.01, 4 * VIEWS.len() * 2);
            assert!(
                outcome.p_value > level,
                "{name}, view {number}, {is_free}: {outcome}"
            );
        }
    }
}

#[test]
#[ignore = "slow: 10 s"]
fn light_near_a_tilted_triangle_is_drawn_as_its_density_says_and_keeps_its_energy() {
    let coats = [Coat::new(1.45, 0.3, 0.3), Coat::new(1.4, 0.45, 0.3)];
    let shape = LeafShape::measured();
    let [r, t, ratio] = [0.55, 0.45, 1.0].map(Lanes::splat);
    let tissue = Tissue::new(&coats, &shape, r, t, ratio);
    assert_closed("leaf", &Bsdf::Leaf(LeafBsdf::new(&coats, &shape, tissue)));
    let opaque = LeafBsdf::new(&coats, &LeafShape::EVEN, Tissue::opaque(Lanes::splat(0.9)));
    assert_closed("plastic", &Bsdf::Leaf(opaque));
    assert_closed("diffuse", &Bsdf::Diffuse(Lanes::splat(0.8)));
    let coats = [1.5, f32::INFINITY].map(|eta| {
        let table = CoatTable::of(eta);
        (eta, Bloom::new(0.0, &table), table)
    });
    let [coat, mirror] = coats
        .each_ref()
        .map(|(eta, bare, table)| table.coat(*eta, [0.3; 2], bare));
    let metal = MetallicRoughness {
        colour: Lanes::splat(0.8),
        metallic: 0.5,
        coat,
        mirror,
        slope: Vec2::new(0.3, -0.2),
    };
    assert_closed("paint and metal", &Bsdf::Metallic(metal));
    let glass = Dielectric {
        eta: 1.5,
        alpha: 0.4,
    };
    assert_closed("rough glass", &Bsdf::Dielectric(glass));
}

#[test]
fn a_mesh_without_normals_scatters_as_its_bsdf_alone_to_the_bit() {
    let surface = tilted(0.0);
    let surface = SurfacePoint {
        shading_normal: surface.geometric_normal,
        rise: [0.0; 2],
        ..surface
    };
    let frame = surface.frame();
    let facet = Facet {
        around: &Above { is_free: false },
        surface: &surface,
    };
    let coats = [Coat::new(1.45, 0.3, 0.3), Coat::new(1.4, 0.45, 0.3)];
    let shape = LeafShape::measured();
    let [r, t, ratio] = [0.55, 0.45, 1.0].map(Lanes::splat);
    let tissue = Tissue::new(&coats, &shape, r, t, ratio);
    let bsdf: Bsdf<'_, 8> = Bsdf::Leaf(LeafBsdf::new(&coats, &shape, tissue));
    for number in 0..2000 {
        let mut stream = Stream::new(9, number, 0, 0);
        let [x, y, z, lobe] = stream.next4();
        let way = Vec3::new(x - 0.5, y - 0.5, z - 0.5).normalize();
        let wo = facet::arriving(&surface, &frame, way);
        assert_eq!(wo, frame.to_local(-way));
        let view: View<'_, 8> = bsdf.seen_from(wo).expect("not from within the plane");
        let [x, y, ..] = stream.next4();
        let u = Vec2::new(x, y);
        let own = view.sample(lobe, u);
        let found = facet.sample((&frame, &view), lobe, u);
        assert_eq!(own.is_some(), found.is_some());
        if let (Some(own), Some((wi_world, found))) = (own, found) {
            assert_eq!(wi_world, frame.to_world(own.wi));
            assert_eq!(own.weight, found.weight);
            assert_eq!(own.pdf, found.pdf);
            let scattered = view.scatter(frame.to_local(wi_world));
            let (_, again) = facet.scatter((&frame, &view), wi_world);
            assert_eq!((scattered.f, scattered.pdf), (again.f, again.pdf));
            assert_eq!(facet.spawn(wi_world), surface.spawn(wi_world));
        }
    }
}
