//! Bands, indices, photons, constituents, instances and light by depth.

use leafmodel::optics::layers::{Face, Incidence, LayeredLeaf, Ordinates, Resolution};
use leafmodel::optics::{Constituent, Contents, ProspectD};
use renderer::instruments::{Direction, Problem, Row};

use super::canopy::discs;
use super::{NORMAL, figures, of, rays};

/// Paper whose reflectance rises in proportion to the wavelength, under a sphere.
fn paper(keys: &str) -> String {
    format!(
        "[meshes.sheet.rectangle]\nwidth_m = 0.1\nheight_m = 0.1\n\
         [materials.paper.diffuse]\nreflectance = {{ table = [[400, 0.1], [2500, 0.625]] }}\n\
         [objects.paper]\nmesh = \"sheet\"\nmaterial = \"paper\"\n\
         [lights.noon.daylight]\nelevation_deg = 60\nazimuth_deg = 0\n\
         [lights.lamp.constant]\nradiance_w_m2_sr_nm = {{ blackbody_k = 3000 }}\n\
         [instruments.ball.sphere]\nobject = \"paper\"\ndiffuse = false\nfaces = \"adaxial\"\n\
         spot = {{ at_mm = [0, 0], diameter_mm = 10 }}\n{keys}"
    )
}

fn band<'r>(rows: &'r [Row], quantity: &str, name: &str) -> &'r Row {
    rows.iter()
        .find(|row| row.quantity == quantity && row.band.as_deref() == Some(name))
        .unwrap_or_else(|| panic!("{quantity} in {name}: {rows:?}"))
}

#[test]
fn bands_of_paper_that_rises_evenly_read_its_reflectance_in_their_middles() {
    for (sensor, red, nir, count) in [
        ("sentinel-2a-msi", ("B4", 664.6), ("B8", 832.8), 13),
        ("landsat-8-oli", ("B4", 654.5), ("B5", 865.0), 9),
    ] {
        let text = paper(&format!(
            "sensor = \"{sensor}\"\nindices = [\"ndvi\", \"pri\"]\n\
             bands_nm = {{ narrow = [710, 10] }}\nband_shape = \"gaussian\"\n"
        ));
        let rows = figures(&text, &rays(1024)).expect("it can be measured");
        let reflectance = |nm: f64| 0.1 + 0.525 * (nm - 400.0) / 2100.0;
        // Three quantities in the sensor's bands, one more and two lines; two indices.
        assert_eq!(rows.len(), 3 * (count + 3) + 2);
        for (name, nm) in [red, nir, ("narrow", 710.0), ("531 nm", 531.0)] {
            let row = band(&rows, "reflectance", name);
            assert!((row.value - reflectance(nm)).abs() < 1e-6, "{row:?}");
            assert_eq!(row.wavelength_nm, Some(nm));
        }
        for (word, a, b) in [("ndvi", nir.1, red.1), ("pri", 531.0, 570.0)] {
            let row = rows.iter().find(|row| row.quantity == word);
            let row = row.expect("it is measured");
            let [a, b] = [a, b].map(reflectance);
            assert!((row.value - (a - b) / (a + b)).abs() < 1e-6, "{row:?}");
            assert_eq!(row.part.as_deref(), Some("reflectance"));
            assert!(row.error < 1e-6, "{row:?}");
        }
    }
}

#[test]
fn an_index_of_a_canopy_has_the_error_that_it_has_over_seeds() {
    // NDVI of a canopy by few rays: red and near infrared light take the same ways, so that the
    // index is surer than by its parts' errors.
    let text = discs(0.1, 1.5, [0.0, 1.0]).replace(
        "reflectance = 0.4\ntransmittance = 0.3",
        "reflectance = { table = [[600, 0.1], [700, 0.1], [750, 0.45], [900, 0.45]] }\n\
         transmittance = { table = [[600, 0.05], [700, 0.05], [750, 0.45], [900, 0.45]] }",
    ) + "[instruments.field.canopy]\nwithin_m = [0, 0, 1, 1]\nsoil = \"ground\"\n\
         indices = [\"ndvi\"]\nbands_nm = { red = [665, 30], nir = [833, 106] }\n";
    let (scene, world, first) = super::built(&text);
    let mut found = Vec::new();
    for seed in 1..=40 {
        let budget = renderer::instruments::Budget { seed, ..rays(2048) };
        let rows = renderer::instruments::read_out(&world, &scene, 0, first[0], &budget);
        let rows = rows.expect("it can be measured").rows;
        let ndvi = rows.into_iter().find(|row| row.quantity == "ndvi");
        found.push(ndvi.expect("it is measured"));
    }
    let count = found.len() as f64;
    let mean = found.iter().map(|row| row.value).sum::<f64>() / count;
    let spread = found
        .iter()
        .map(|row| (row.value - mean).powi(2))
        .sum::<f64>()
        / (count - 1.0);
    let told = found.iter().map(|row| row.error.powi(2)).sum::<f64>() / count;
    // The variance of 40 seeds is uncertain by √(2 / 39) = 0.23.
    assert!((spread / told - 1.0).abs() < 0.8, "{spread} {told}");
}

#[test]
fn photons_are_shares_of_those_that_fall_in() {
    let grey = |keys: &str| paper(keys).replace("{ table = [[400, 0.1], [2500, 0.625]] }", "0.3");
    for incident in [
        "par_umol_m2_s = 1000",
        "par_umol_m2_s = 1000, light = \"noon\"",
        "par_umol_m2_s = 1000, spectrum = { blackbody_k = 3000 }",
    ] {
        let keys = format!("wavelengths_nm = [550]\nincident = {{ {incident} }}\n");
        let rows = figures(&grey(&keys), &rays(1024)).expect("it can be measured");
        for (quantity, expected) in [
            ("incident_photon_flux", 1000.0),
            ("reflected_photon_flux", 300.0),
            ("transmitted_photon_flux", 0.0),
            ("absorbed_photon_flux", 700.0),
        ] {
            let row = band(&rows, quantity, "PAR");
            let off = (row.value - expected).abs();
            assert!(off < 1e-3 + 0.01 * row.error, "{row:?} for {expected}");
            assert_eq!(row.unit, "umol m-2 s-1");
        }
    }
    // Paper that reflects more of red light reflects more photons of a lamp than of daylight.
    let reflected = |light: &str| {
        let incident = format!("incident = {{ par_umol_m2_s = 1000, {light} }}\n");
        let text = paper(&format!("wavelengths_nm = [550]\n{incident}"));
        let rows = figures(&text, &rays(1024)).expect("it can be measured");
        band(&rows, "reflected_photon_flux", "PAR").value
    };
    let lamp = reflected("light = \"lamp\"");
    assert_eq!(lamp, reflected("spectrum = { blackbody_k = 3000 }"));
    let (noon, even) = (reflected("light = \"noon\""), reflected("spectrum = 1"));
    assert!(
        lamp > even + 5.0 && even > noon + 0.5,
        "{lamp} {even} {noon}"
    );
    // An even spectrum of 1 W m⁻² nm⁻¹ has 300 nm · 550 nm / (h c N) of photons.
    let keys = "wavelengths_nm = [550]\nincident = { irradiance_w_m2 = 300, spectrum = 1 }\n";
    let rows = figures(&grey(keys), &rays(1024)).expect("it can be measured");
    let all = band(&rows, "incident_photon_flux", "PAR").value;
    assert!((all - 1379.29).abs() < 0.01, "{all}");
}

const CONTENTS: &str = "structure = 1.5\nchlorophyll_ug_per_cm2 = 40\ncarotenoids_ug_per_cm2 = 8\n\
    anthocyanins_ug_per_cm2 = 2\nbrown = 0.1\nwater_cm = 0.01\ndry_matter_g_per_cm2 = 0.009\n";

#[test]
fn constituents_share_what_a_leaf_absorbs_by_their_absorption() {
    let text = format!(
        "[meshes.sheet.rectangle]\nwidth_m = 0.1\nheight_m = 0.1\n[materials.leaf.leaf]\n\
         [materials.leaf.leaf.contents]\n{CONTENTS}\
         [objects.leaf]\nmesh = \"sheet\"\nmaterial = \"leaf\"\n\
         [instruments.ball.sphere]\nobject = \"leaf\"\nwavelengths_nm = [450, 550, 680, 970, 1650]\n\
         incidence_deg = [0]\nconstituents = true\n\
         spot = {{ at_mm = [0, 0], diameter_mm = 10 }}\n"
    );
    let rows = figures(&text, &rays(1 << 14)).expect("it can be measured");
    let contents = Contents::new(1.5, 40.0, 8.0, 2.0, 0.1, 0.01, 0.009).expect("in range");
    for nm in [450.0, 550.0, 680.0, 970.0, 1650.0] {
        let at = ProspectD::coefficients(nm).expect("it is in the table");
        let absorbed = |constituent| contents[constituent] * at.absorption[constituent];
        let all: f64 = Constituent::ABSORBING.into_iter().map(absorbed).sum();
        for light in [NORMAL, Direction::Diffuse] {
            let absorptance = of(&rows, "absorptance", light, nm).next();
            let absorptance = absorptance.expect("it is measured").value;
            let parts: Vec<&Row> = of(&rows, "absorbed_by_constituent", light, nm)
                .filter(|row| row.face == Some("adaxial"))
                .collect();
            let count = Constituent::ABSORBING.len();
            assert_eq!(parts.len(), count + 1);
            let sum: f64 = parts.iter().map(|row| row.value).sum();
            assert!(
                (sum - absorptance).abs() < 1e-6,
                "{nm} nm: {sum} {absorptance}"
            );
            for (row, constituent) in parts.iter().zip(Constituent::ABSORBING) {
                assert_eq!(row.part.as_deref(), Some(constituent.name()));
                let expected = absorptance * absorbed(constituent) / all;
                assert!(
                    (row.value - expected).abs() < 2e-6,
                    "{row:?} for {expected}"
                );
            }
            assert!(parts[count].value.abs() < 1e-9, "{:?}", parts[count]);
        }
    }
}

#[test]
fn leaves_constituents_and_objects_absorb_the_same_in_all() {
    let discs = discs(0.1, 1.0, [0.0, 1.0]);
    let material = discs.find("[materials.leaf.leaf]").expect("it is there");
    let soil = discs.find("[materials.soil").expect("it is there");
    let text = format!(
        "{}[materials.leaf.leaf]\n[materials.leaf.leaf.contents]\n{CONTENTS}{}\
         [instruments.field.canopy]\nwithin_m = [0, 0, 1, 1]\nwavelengths_nm = [450, 680, 800]\n\
         soil = \"ground\"\nconstituents = true\ninstances = true\n\
         incident = {{ par_umol_m2_s = 1500 }}\n",
        &discs[..material],
        &discs[soil..]
    );
    let rows = figures(&text, &rays(1 << 13)).expect("it can be measured");
    for nm in [450.0, 680.0, 800.0] {
        let sum = |word| {
            of(&rows, word, NORMAL, nm)
                .map(|row| row.value)
                .sum::<f64>()
        };
        let all = sum("absorbed");
        for word in ["absorbed_by_constituent", "absorbed_by_instance"] {
            assert!(
                (sum(word) - all).abs() < 1e-5,
                "{nm} nm: {word} {} {all}",
                sum(word)
            );
        }
        let fates = [
            all,
            sum("reflected"),
            sum("transmitted"),
            sum("absorbed_by_soil"),
        ];
        assert!((fates.iter().sum::<f64>() - 1.0).abs() < 1e-9, "{fates:?}");
    }
    let photons = |word: &str| {
        let own = rows.iter().filter(|row| row.quantity == word);
        own.map(|row| row.value).collect::<Vec<f64>>()
    };
    let all = photons("absorbed_photon_flux")[0];
    assert!(all > 100.0 && all < 1500.0, "{all}");
    let of_constituents: f64 = photons("photon_flux_absorbed_by_constituent").iter().sum();
    assert!(
        (of_constituents - all).abs() < 1e-2,
        "{of_constituents} {all}"
    );
    // Those of leaves are by their own area, of which LAI 1 is as much as there is ground.
    let of_leaves = photons("photon_flux_absorbed_by_instance");
    let mean = of_leaves.iter().sum::<f64>() / of_leaves.len() as f64;
    assert!((mean / all - 1.0).abs() < 0.03, "{mean} {all}");
    assert!(of_leaves.iter().all(|flux| *flux < 1510.0));
}

/// A sheet of tissue with these contents and a look into its depth.
fn deep(contents: &str, keys: &str) -> String {
    format!(
        "[meshes.sheet.rectangle]\nwidth_m = 0.1\nheight_m = 0.1\n[materials.leaf.leaf]\n\
         [materials.leaf.leaf.contents]\n{contents}\
         [materials.paper.diffuse]\nreflectance = 0.5\n\
         [objects.leaf]\nmesh = \"sheet\"\nmaterial = \"leaf\"\n\
         [objects.paper]\nmesh = \"sheet\"\nmaterial = \"paper\"\n\
         [instruments.inside.depth]\nobject = \"leaf\"\n{keys}"
    )
}

#[test]
fn a_depth_profile_holds_all_that_a_layered_leaf_absorbs() {
    let text = deep(
        CONTENTS,
        "wavelengths_nm = [450, 680, 800]\nincidence_deg = [0, 60]\ndiffuse = true\n\
         faces = \"both\"\nslices = 4\n",
    );
    let rows = figures(&text, &rays(1024)).expect("it can be measured");
    let contents = Contents::new(1.5, 40.0, 8.0, 2.0, 0.1, 0.01, 0.009).expect("in range");
    let leaf = LayeredLeaf::new(&contents);
    for nm in [450.0, 680.0, 800.0] {
        let at = ProspectD::coefficients(nm).expect("it is in the table");
        let cosine = 0.5;
        let light = Ordinates::new(&leaf.stack(&at), Resolution::FINE, &[1.0, cosine])
            .expect("directions are in range");
        for (incidence, direction) in [
            (Incidence::NORMAL, NORMAL),
            (
                Incidence::Directional { cosine },
                Direction::Beam(60_f64.to_radians()),
            ),
            (Incidence::Lambertian, Direction::Diffuse),
        ] {
            for (face, name) in [(Face::First, "adaxial"), (Face::Last, "abaxial")] {
                let fluxes = light.fluxes(face, &[incidence]).expect("it is solved");
                let slices: Vec<&Row> = of(&rows, "absorbed_per_depth", direction, nm)
                    .filter(|row| row.face == Some(name))
                    .collect();
                assert_eq!(slices.len(), 5 * 4);
                // Slices begin where those before end.
                let mut above = 0.0;
                let mut sum = 0.0;
                for row in &slices {
                    let half = row.depth_um.expect("it has a depth") - above;
                    above += 2.0 * half;
                    sum += 2.0 * half * row.value;
                    assert!(
                        half > 0.0 && row.error == 0.0 && row.unit == "um-1",
                        "{row:?}"
                    );
                }
                let expected = 1.0 - fluxes[0].reflected - fluxes[0].transmitted;
                assert!(
                    (sum - expected).abs() < 2e-3,
                    "{nm} nm, {name}: {sum} {expected}"
                );
            }
        }
    }
}

#[test]
fn a_leaf_without_thickness_has_no_depth() {
    let of_contents = |water: &str, dry: &str| {
        let contents = format!(
            "structure = 1.5\nchlorophyll_ug_per_cm2 = 20\ncarotenoids_ug_per_cm2 = 5\n\
             water_cm = {water}\ndry_matter_g_per_cm2 = {dry}\n"
        );
        figures(&deep(&contents, "wavelengths_nm = [550]\n"), &rays(1024))
    };
    let rows = of_contents("0.01", "0").expect("water has a thickness");
    assert!(!rows.is_empty() && rows.iter().all(|row| row.value.is_finite()));
    let error = of_contents("0", "0").expect_err("nothing has a thickness");
    assert!(
        error
            .to_string()
            .ends_with("so that its layers have no thickness"),
        "{error}"
    );
}

#[test]
fn a_leaf_that_absorbs_next_to_nothing_is_filled_with_light_by_its_index() {
    // Even light from both sides of a medium that loses nothing has the radiance n² L everywhere in
    // it: the fluence rate is 4 n² of the irradiance of one side. A layer that scatters nothing
    // lacks the directions into which no light of the one beside it, of index m, is refracted: it has
    // 1 − √(1 − m² / n²) of them.
    let pale = "structure = 1.5\nchlorophyll_ug_per_cm2 = 0\ncarotenoids_ug_per_cm2 = 0\n\
        water_cm = 0.01\ndry_matter_g_per_cm2 = 0.00000001\n";
    let nm = 480.0;
    let text = deep(
        pale,
        "wavelengths_nm = [480]\ndiffuse = true\nfaces = \"both\"\nslices = 3\n",
    );
    let rows = figures(&text, &rays(1024)).expect("it can be measured");
    let contents = Contents::new(1.5, 0.0, 0.0, 0.0, 0.0, 0.01, 1e-8).expect("in range");
    let at = ProspectD::coefficients(nm).expect("it is in the table");
    let stack = LayeredLeaf::new(&contents).stack(&at);
    let on_face = |face: &'static str| {
        of(&rows, "fluence", Direction::Diffuse, nm).filter(move |row| row.face == Some(face))
    };
    let mut compared = 0;
    for (upper, lower) in on_face("adaxial").zip(on_face("abaxial")) {
        assert_eq!((upper.depth_um, &upper.part), (lower.depth_um, &lower.part));
        let names =
            leafmodel::optics::layers::Tissue::ALL.map(leafmodel::optics::layers::Tissue::name);
        let layer = names
            .iter()
            .position(|name| upper.part.as_deref() == Some(*name));
        let index = stack.layers()[layer.expect("it is a layer")].index;
        // Light of epidermis and cuticle comes from the mesophyll beside.
        let layers = stack.layers();
        let [palisade, spongy] = [layers[2], layers[3]].map(|layer| layer.index);
        let most = match upper.part.as_deref() {
            Some("cuticle" | "upper_epidermis") => palisade,
            Some("lower_epidermis") => spongy,
            Some(_) | None => index,
        };
        let missing = f64::sqrt((1.0 - (most / index).powi(2)).max(0.0));
        let expected = 4.0 * index * index * (1.0 - missing);
        let found = upper.value + lower.value;
        assert!(
            (found / expected - 1.0).abs() < 1e-3,
            "{upper:?}: {found} for {expected}"
        );
        compared += 1;
    }
    assert!(compared >= 12, "{compared}");
}

#[test]
fn paper_has_no_depth_and_many_leaves_are_too_many() {
    let paper = deep(CONTENTS, "wavelengths_nm = [550]\n").replace(
        "[instruments.inside.depth]\nobject = \"leaf\"",
        "[instruments.inside.depth]\nobject = \"paper\"",
    );
    let error = figures(&paper, &rays(1024)).expect_err("paper holds nothing");
    assert!(
        matches!(error.problem, Problem::NoContents { .. }),
        "{error}"
    );
    let many = format!(
        "{}[instruments.field.canopy]\nwithin_m = [0, 0, 1, 1]\ninstances = true\n\
         incidence_deg = [0, 10, 20, 30, 40]\n",
        discs(0.01, 1.0, [0.0, 1.0])
    );
    let error = figures(&many, &rays(1024)).expect_err("there are 3000 of them");
    assert!(
        matches!(error.problem, Problem::TooManyInstances { .. }),
        "{error}"
    );
}
