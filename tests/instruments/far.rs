//! Instruments far from the origin of the scene, and from its camera.

use renderer::instruments::{Row, notes};

use super::{built, figures_of, rays};

/// A place that single precision rounds by 3 cm.
const FAR: [f64; 3] = [500_000.0, -900_000.0, 800_000.0];

/// A canopy, with a leaf beside it, around a place.
fn scene([x, y, z]: [f64; 3]) -> String {
    format!(
        r#"
[meshes.disc.disc]
radius_m = 0.02
[meshes.ground.rectangle]
width_m = 1
height_m = 1
[materials.leaf.leaf]
abaxial_ratio = 1
adaxial = {{ eta = 1, alpha = 1 }}
abaxial = {{ eta = 1, alpha = 1 }}
[materials.leaf.leaf.measured]
reflectance = 0.4
transmittance = 0.3
[materials.soil.diffuse]
reflectance = 0.2
[objects.leaves]
mesh = "disc"
material = "leaf"
volume = {{ within_m = [{x}, {y}, {}, {}, {}, {}], lai = 1, seed = 4 }}
[objects.ground]
mesh = "ground"
material = "soil"
position_m = [{}, {}, {z}]
[objects.leaf]
mesh = "disc"
material = "leaf"
rotate_deg = [30, 0, 20]
position_m = [{}, {y}, {z}]
[instruments.field.canopy]
within_m = [{x}, {y}, {}, {}]
soil = "ground"
incidence_deg = [0, 40]
diffuse = true
layers_m = [{}]
wavelengths_nm = [550]
detector = {{ zenith_deg = [0, 30], relative_azimuth_deg = [0] }}
[instruments.ball.sphere]
object = "leaf"
wavelengths_nm = [550]
spot = {{ at_mm = [3, -2], diameter_mm = 20 }}
[instruments.whole.sphere]
object = "leaf"
wavelengths_nm = [550]
diffuse = true
[instruments.arm.gonio]
object = "leaf"
wavelengths_nm = [550]
detector = {{ zenith_deg = [-30, 40], relative_azimuth_deg = [0, 90] }}
"#,
        z + 0.1,
        x + 1.0,
        y + 1.0,
        z + 1.1,
        x + 0.5,
        y + 0.5,
        x - 3.0,
        x + 1.0,
        y + 1.0,
        z + 0.5,
    )
}

#[test]
fn instruments_far_away_measure_as_at_the_origin() {
    let measured = |at: [f64; 3]| -> Vec<Row> {
        let built = built(&scene(at));
        let told = notes(&built.1, &built.0, 0);
        // Of the leaf beside the canopy, and of leaves whose middle is beyond its box.
        let outside = told.iter().filter(|note| note.contains("`leaves`"));
        assert_eq!(outside.count(), 0, "{told:?}");
        figures_of(&built, &rays(1 << 13)).expect("it can be measured")
    };
    let near = measured([0.0; 3]);
    assert!(near.len() > 30, "{}", near.len());
    // Losses began at a kilometre.
    for share in [0.001, 0.1, 1.0] {
        let far = measured(FAR.map(|coordinate| (coordinate * share).round()));
        assert_eq!(near.len(), far.len());
        for (near, far) in near.iter().zip(&far) {
            let same = (far.quantity, far.incidence, far.view, far.face);
            assert_eq!(same, (near.quantity, near.incidence, near.view, near.face));
            // The same rays but for roundings, by which a few meet another leaf.
            let room = 0.3 * near.error + 1e-6;
            assert!(
                (far.value - near.value).abs() < room,
                "{far:?} for {near:?}"
            );
        }
    }
}
