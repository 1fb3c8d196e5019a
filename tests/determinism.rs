//! Same bytes for any number of threads.

use std::sync::atomic::AtomicBool;

use renderer::image::openexr;
use renderer::integrator::develop::develop;
use renderer::integrator::render::{Job, render};
use support::picture::world_of;

const SCENE: &str = "
format = 1
[film.rgb]
size = [40, 30]
spp = 20
[camera.perspective]
position_m = [0, -0.3, 0.2]
look_at_m = [0, 0, 0.02]
vertical_fov_deg = 30
aperture_diameter_mm = 5
[materials.leaf.leaf.contents]
structure = 1.5
chlorophyll_ug_per_cm2 = 40
carotenoids_ug_per_cm2 = 8
water_cm = 0.01
dry_matter_g_per_cm2 = 0.005
[meshes.ball.sphere]
radius_m = 0.05
[meshes.floor.rectangle]
width_m = 1
height_m = 1
[materials.grey.diffuse]
reflectance = 0.4
[objects.floor]
mesh = \"floor\"
material = \"grey\"
position_m = [0, 0, -0.05]
[objects.ball]
mesh = \"ball\"
material = \"leaf\"
[lights.sun.distant]
irradiance_w_m2_nm = { blackbody_k = 5800 }
elevation_deg = 40
azimuth_deg = 100
[lights.sky.constant]
radiance_w_m2_sr_nm = { d65 = 0.05 }
";

fn exr_bytes(threads: usize) -> Vec<u8> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .expect("threads");
    pool.install(|| {
        let (scene, world) = world_of(SCENE);
        let job = Job {
            width: 40,
            height: 30,
            spp: 20,
            seed: 5,
        };
        let rendered = render(&world, &job, &AtomicBool::new(false), &|_| ()).expect("it fits");
        let folder = tempfile::tempdir().expect("a place for temporary files");
        let path = folder.path().join("picture.exr");
        openexr::write(&develop(&scene, &world, &job, &rendered), &path).expect("it is written");
        std::fs::read(&path).expect("it was just written")
    })
}

#[test]
fn a_picture_has_the_same_bytes_on_any_number_of_threads() {
    let one = exr_bytes(1);
    for threads in [2, 3, 8] {
        assert!(one == exr_bytes(threads), "{threads} threads");
    }
}
