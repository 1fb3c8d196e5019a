//! Measured leaves: what their files mean.

use renderer::scene::description::material::leaf::LeafTissue;
use renderer::scene::description::{LeafFaces, Material, Spectrum};

use super::{accept, text_of};

/// A scene with a material of a measured leaf, and the material's parts.
fn leaf(measured: &str) -> (LeafTissue, LeafFaces, Vec<String>) {
    let text = format!(
        "{}\n[materials.own.leaf]\nmeasured = {measured}\n",
        text_of("minimal.toml")
    );
    let loaded = accept(&text, "measured.toml", &[]);
    let materials = &loaded.description.materials;
    let own = materials.iter().find(|material| material.name == "own");
    let Material::Leaf(leaf) = &own.expect("it is there").value else {
        panic!("it is a leaf");
    };
    let said = loaded.warnings.iter().map(ToString::to_string);
    // No object has the material, which is told too.
    let said = said.filter(|warning: &String| warning.contains("scene::units"));
    (leaf.tissue.clone(), leaf.faces.clone(), said.collect())
}

fn points(spectrum: &Spectrum) -> &[(f64, f64)] {
    match spectrum {
        Spectrum::Table { points, .. } => points,
        Spectrum::Constant(_) | Spectrum::D65 { .. } | Spectrum::Blackbody { .. } => {
            panic!("{spectrum:?} is no table")
        }
    }
}

#[test]
fn both_faces_of_a_table_in_percent_and_micrometres_are_read_and_reported() {
    let (tissue, faces, said) = leaf("{ file = \"leaves.csv\", leaf = \"oak\" }");
    let LeafTissue::Measured {
        reflectance,
        transmittance,
    } = tissue
    else {
        panic!("it was measured");
    };
    let [(first, r), ..] = points(&reflectance)[..] else {
        panic!("it has rows");
    };
    assert!((first - 380.0).abs() < 1e-9 && (r - 0.05).abs() < 1e-12);
    assert!((points(&transmittance)[42].1 - 0.01).abs() < 1e-12);
    let abaxial = faces.abaxial_reflectance.expect("both faces were measured");
    let pairs = points(&abaxial).iter().zip(points(&reflectance));
    for (abaxial, adaxial) in pairs {
        assert!((abaxial.1 - 1.8 * adaxial.1).abs() < 1e-9);
    }
    let said = said.join("\n");
    assert!(said.contains("µm") && said.contains("percent"), "{said}");
}

#[test]
fn units_that_the_scene_gives_are_no_guess() {
    let file = "file = \"leaves.csv\", leaf = \"oak\"";
    let guessed = leaf(&format!("{{ {file} }}"));
    let (tissue, _, said) = leaf(&format!(
        "{{ {file}, wavelengths = \"um\", values = \"percent\" }}"
    ));
    assert_eq!(format!("{tissue:?}"), format!("{:?}", guessed.0));
    assert!(said.is_empty(), "{said:?}");
}

#[test]
fn files_of_spectrometers_are_read_for_each_spectrum() {
    let (tissue, faces, said) =
        leaf("{ reflectance = { file = \"oak.sig\" }, transmittance = { file = \"oak.txt\" } }");
    let LeafTissue::Measured {
        reflectance,
        transmittance,
    } = tissue
    else {
        panic!("it was measured");
    };
    assert!((points(&reflectance)[7].1 - 0.3).abs() < 1e-12);
    assert!((points(&transmittance)[7].1 - 0.4).abs() < 1e-12);
    assert!(faces.abaxial_ratio.is_none() && faces.abaxial_reflectance.is_none());
    assert_eq!(said.len(), 1, "percent of the .sig file: {said:?}");
}
