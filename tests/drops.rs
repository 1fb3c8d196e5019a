//! Drops on leaves: what their water does to the light of what they stand on.

use support::picture::mean_and_error;

use crate::radiometry::scene;

/// A leaf on the ground plane and a drop on it.
fn leaf_and_drop(reflectance: f64, transmittance: f64, angle: f64) -> String {
    format!(
        "
[materials.leaf.leaf]
abaxial_ratio = 1
adaxial = {{ eta = 1.0, alpha = 0.3 }}
abaxial = {{ eta = 1.0, alpha = 0.3 }}
[materials.leaf.leaf.measured]
reflectance = {reflectance}
transmittance = {transmittance}
[meshes.sheet.rectangle]
width_m = 0.02
height_m = 0.02
[objects.sheet]
mesh = \"sheet\"
material = \"leaf\"
[materials.water.dielectric]
eta = 1.33
[meshes.drop.drop]
volume_ul = 2
contact_angle_deg = {angle}
segments = 96
[objects.drop]
mesh = \"drop\"
material = \"water\"
"
    )
}

#[test]
fn drops_on_a_lossless_leaf_in_a_white_furnace_cannot_be_seen() {
    let sky = "[lights.sky.constant]\nradiance_w_m2_sr_nm = 1\n";
    // Through the drop alone, and with its rim: the side goes on a little below the leaf, where a ray may
    // come into the water from the wrong side.
    for (fov, allowed) in [(0.6, 3e-4), (1.2, 5e-3)] {
        for (height, angle) in [(0.1, 60.0), (0.1, 110.0), (-0.1, 60.0), (-0.1, 110.0)] {
            let blocks = leaf_and_drop(0.6, 0.4, angle) + sky;
            let camera = format!(
                "position_m = [0.01, -0.02, {height}]\nlook_at_m = [0, 0, 0]\nvertical_fov_deg = {fov}"
            );
            let text = scene(&camera, "", &blocks).replace("spp = 64", "spp = 256");
            let (mean, error) = mean_and_error(&text, 0, 4);
            eprintln!("{fov}° from {height} m, {angle}°: {mean:.5} ± {error:.1e}");
            assert!(
                error < 0.5 * allowed,
                "the error {error} hides what is to be seen"
            );
            assert!(
                (mean - 1.0).abs() < allowed,
                "{fov}° from {height} m, {angle}°: {mean} ± {error}"
            );
        }
    }
}

#[test]
fn a_drop_on_a_leaf_that_the_sun_shines_through_is_as_bright_as_the_leaf() {
    // Seen from above through the middle of the drop. Its surface sends back 2 %, of which some comes
    // again from the leaf. A leaf under the water itself would have 1/η² of the light, 0.56.
    let sun = "[lights.sun.distant]\nirradiance_w_m2_nm = 1\ntowards = [0, 0, -1]\n";
    let camera = "position_m = [0, 0, 0.1]\nlook_at_m = [0, 0, 0]\nup = [0, 1, 0]\n\
                  vertical_fov_deg = 0.1";
    let under = leaf_and_drop(0.3, 0.4, 70.0) + sun;
    let bare = under.replace(
        "[objects.drop]",
        "[objects.drop]\nposition_m = [0.015, 0, 0]",
    );
    let [under, bare] = [under, bare].map(|blocks| {
        let text = scene(camera, "", &blocks).replace("spp = 64", "spp = 1024");
        mean_and_error(&text, 0, 8)
    });
    let ratio = under.0 / bare.0;
    eprintln!("{ratio:.4} ± {:.1e}", under.1 / bare.0);
    assert!(
        under.1 < 2e-3 * under.0,
        "the error hides what is to be seen"
    );
    assert!((0.97..1.02).contains(&ratio), "{ratio}");
}
