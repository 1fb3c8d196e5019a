//! Maps of contents as files in physical units.

use std::path::Path;
use std::sync::atomic::AtomicBool;

use leafmodel::blade::UvFrame;
use leafmodel::blade::contents_map::ContentsMap;
use leafmodel::blade::senescence::AgeSource;
use leafmodel::leaf::LeafPlan;
use leafmodel::optics::Constituent;
use leafmodel::shape::outline::Outline;

use crate::cli::signals;
use crate::cli::terminal::{Failure, say};
use crate::export::mitsuba::map_picture;
use crate::image::{Attribute, Picture, openexr};
use crate::material::contents_texture::ContentsTexture;

/// Writes the map of one blade as `DIR/NAME.exr`, on a day of its ageing if it has one.
pub(super) fn write(
    folder: &Path,
    name: &str,
    map: &ContentsMap,
    outline: &Outline,
    day: Option<f64>,
    stop: &AtomicBool,
) -> Result<(), Failure> {
    signals::check(stop)?;
    std::fs::create_dir_all(folder).map_err(Failure::system_at(folder))?;
    let path = folder.join(format!("{name}.exr"));
    openexr::write(&picture(name, map, outline, day), &path).map_err(Failure::system)?;
    say(path.display());
    Ok(())
}

/// The day of a leaf's ageing, if it ages by days.
pub(super) fn day(plan: &LeafPlan) -> Option<f64> {
    match plan.senescence.as_ref()?.source {
        AgeSource::Day { day, .. } => Some(day),
        AgeSource::Revenue { .. } => None,
    }
}

/// The map with attributes for the units of its values and its place.
fn picture(name: &str, map: &ContentsMap, outline: &Outline, day: Option<f64>) -> Picture {
    let texture = ContentsTexture::new(map.width as usize, map.height as usize, map.texels.clone());
    let mut picture = map_picture(&texture);
    let text = |key: &str, value: String| (format!("lamina:{key}"), Attribute::Text(value));
    let frame = UvFrame::around(outline.points());
    let [low, high] = [frame.min, frame.min + frame.size];
    let software = format!("Lamina {}", env!("CARGO_PKG_VERSION"));
    picture.attributes = vec![
        ("software".to_owned(), Attribute::Text(software)),
        text("leaf", name.to_owned()),
        text(
            "boxMm",
            format!("{} {} {} {}", low.x, low.y, high.x, high.y),
        ),
        text(
            "rows",
            "first row at the least y, towards the base; columns from the least x".to_owned(),
        ),
    ];
    let units = Constituent::ALL.map(|constituent| {
        let key = format!("unit.{}", constituent.channel());
        text(&key, in_ascii(constituent.unit()))
    });
    picture.attributes.extend(units);
    if let Some(day) = day {
        let day = ("lamina:day".to_owned(), Attribute::Double(day));
        picture.attributes.push(day);
    }
    picture
}

/// A unit as written in attributes; 1 for a pure number.
fn in_ascii(unit: &str) -> String {
    match unit {
        "" => "1".to_owned(),
        unit => unit.replace('µ', "u").replace('²', "2"),
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec2;
    use leafmodel::species::find;

    use super::*;
    use crate::scene::assets::contents_map;
    use crate::scene::description::Held;
    use crate::scene::load::load;
    use leafmodel::grow_options::GrowOptions;
    use leafmodel::optics::Texel;

    const SCENE: &str = r#"
format = 1

[film.rgb]
size = [16, 16]
spp = 1

[camera.perspective]
position_m = [0, -1, 0.2]
look_at_m = [0, 0, 0]
vertical_fov_deg = 30

[materials.leaf.leaf.map]
file = "maps/birch-autumn.exr"

[meshes.card.rectangle]
width_m = 0.1
height_m = 0.1

[objects.card]
mesh = "card"
material = "leaf"

[lights.sky.constant]
radiance_w_m2_sr_nm = 0.1
"#;

    #[test]
    fn a_material_finds_in_a_written_map_what_the_leaf_holds() {
        let mut plan = find("birch-autumn").expect("a preset").plan();
        plan.map_size = 200;
        plan.venation = find("arcuate").expect("a preset").plan().venation;
        let lamina = plan.grow_lamina().expect("a good plan");
        let map = GrowOptions::default()
            .contents(&plan, &lamina)
            .expect("a good plan");
        let folder = tempfile::tempdir().expect("a folder");
        let maps = folder.path().join("maps");
        let stop = AtomicBool::new(false);
        write(
            &maps,
            "birch-autumn",
            &map,
            &lamina.outline,
            day(&plan),
            &stop,
        )
        .expect("written");
        let scene = folder.path().join("scene.toml");
        std::fs::write(&scene, SCENE).expect("written");
        let loaded = load(&scene, &[]).expect("a good scene").description;
        let material = &loaded.materials[0].value;
        let Some(Held::Map { file, .. }) = material.held() else {
            panic!("{material:?}");
        };
        let texture = contents_map(file).expect("a map");
        // The file stores floats unchanged. At the centres of texels, where nothing is
        // interpolated, values are recovered up to rounding.
        let mut seen = 0;
        for row in (0..map.height).step_by(7) {
            for column in (0..map.width).step_by(5) {
                let centre = |i: u32, count: u32| ((f64::from(i) + 0.5) / f64::from(count)) as f32;
                let uv = Vec2::new(centre(column, map.width), centre(row, map.height));
                let held = map.texels[(row * map.width + column) as usize];
                for (constituent, found) in texture.at(uv).map(f64::from) {
                    let held = f64::from(held[constituent]);
                    assert!(
                        (found - held).abs() <= 2e-4 * held.abs() + 1e-6,
                        "{found} {held}"
                    );
                }
                seen += 1;
            }
        }
        assert!(seen > 500, "{seen}");
        assert_eq!(texture.texels(), map.texels.as_slice());
    }

    #[test]
    fn a_map_names_units_place_and_program() {
        let plan = find("ginkgo-autumn").expect("a preset").plan();
        let outline = plan
            .outline
            .grow(plan.length_mm, plan.seed)
            .expect("a good outline");
        let map = ContentsMap {
            width: 1,
            height: 1,
            texels: vec![Texel::splat(1.0)],
        };
        let picture = picture("leaf", &map, &outline, day(&plan));
        let bytes = openexr::encode(&picture).expect("encoded");
        let back = openexr::decode(&bytes).expect("decoded");
        let told = |name: &str| {
            let found = back.attributes.iter().find(|(key, _)| key == name);
            match found.map(|(_, value)| value) {
                Some(Attribute::Text(text)) => text.clone(),
                other => panic!("{name} is {other:?}"),
            }
        };
        for (content, unit) in [
            ("structure", "1"),
            ("chlorophyll", "ug/cm2"),
            ("betaxanthins", "ug/cm2"),
            ("brown", "1"),
            ("water", "cm"),
            ("dry_matter", "g/cm2"),
            ("proteins", "g/cm2"),
            ("extra", "ug/cm2"),
        ] {
            assert_eq!(told(&format!("lamina:unit.{content}")), unit);
        }
        assert!(told("software").starts_with("Lamina "));
        let numbers = told("lamina:boxMm");
        let numbers: Vec<f64> = numbers
            .split(' ')
            .map(|n| n.parse().expect("a number"))
            .collect();
        let (low, high) = outline.bounds();
        // The frame of the map keeps the size, so that its far corner may be rounded.
        for (number, side) in numbers.iter().zip([low.x, low.y, high.x, high.y]) {
            assert!((number - side).abs() < 1e-12, "{numbers:?}");
        }
        assert_eq!(numbers.len(), 4);
        let day = back.attributes.iter().find(|(key, _)| key == "lamina:day");
        assert!(
            matches!(day, Some((_, Attribute::Double(day))) if *day == 27.0),
            "{day:?}"
        );
    }
}
