//! How long the maps of contents of a maple take at 2048 texels:
//! `cargo bench -p lamina-benches --bench contents`.
//!
//! All threads. Pigments alone, with three layers, ageing, both, and both over a clonal mosaic that
//! has grown; and the growing of that mosaic, which a map with one needs once.

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use leafmodel::blade::UvFrame;
use leafmodel::blade::ageing::Place;
use leafmodel::blade::contents_map::ContentsMap;
use leafmodel::blade::layers::{Change, Layer, Mode};
use leafmodel::blade::masks::{Mask, RimWidth};
use leafmodel::blade::senescence::Withering;
use leafmodel::grow_options::GrowOptions;
use leafmodel::leaf::LeafPlan;
use leafmodel::mosaic::pattern::LaminaPattern;
use leafmodel::optics::{Constituent, PerConstituent};
use leafmodel::species::find;
use leafmodel::venation::network::VeinSegment;

fn maps(criterion: &mut Criterion) {
    let maple = LeafPlan {
        map_size: 2048,
        ..find("sugar-maple-autumn").expect("a preset").plan()
    };
    let lamina = maple.grow_lamina().expect("a good plan");
    let veins: Vec<VeinSegment> = lamina.network.segments().collect();
    let frame = UvFrame::around(lamina.outline.points());
    let place = Place {
        frame: &frame,
        margin: lamina.outline.points(),
        veins: &veins,
        base: lamina.outline.base(),
        apex: lamina.outline.apex(),
    };
    let senescence = maple.senescence.expect("it ages");
    let croton = find("croton-variegated").expect("a preset").plan();
    let mosaic = croton.mosaic.expect("it has one");
    let grown = || mosaic.on_lamina(&lamina.outline, maple.seed, GrowOptions::default());
    let pattern = grown().expect("a good plan");

    let mut group = criterion.benchmark_group("contents of a maple, 2048 texels");
    group.measurement_time(Duration::from_secs(8));
    group.sample_size(10);
    let paint = |pattern: Option<&LaminaPattern>, layers: &[Layer], ages: bool| {
        // What an age or a layer needs to know of the leaf is found out each time.
        let withering =
            ages.then(|| Withering::new(&senescence, &place, None, maple.seed).expect("by days"));
        let (tissue, size, seed) = (black_box(&maple.tissue), maple.map_size, maple.seed);
        let withering = withering.as_ref();
        ContentsMap::paint_layered(&place, tissue, pattern, layers, withering, size, seed)
            .expect("all in range")
    };
    let layers = layers();
    group.bench_function("pigments", |b| b.iter(|| paint(None, &[], false)));
    group.bench_function("pigments, three layers", |b| {
        b.iter(|| paint(None, &layers, false));
    });
    group.bench_function("pigments, ageing", |b| b.iter(|| paint(None, &[], true)));
    group.bench_function("pigments, three layers, ageing", |b| {
        b.iter(|| paint(None, &layers, true));
    });
    group.bench_function("pigments, mosaic, three layers, ageing", |b| {
        b.iter(|| paint(Some(&pattern), &layers, true));
    });
    group.bench_function("the mosaic itself, 2000 cells and 35 days", |b| {
        b.iter(grown);
    });
    group.finish();
}

/// A rim that wanders, green along the larger veins, patches.
fn layers() -> [Layer; 3] {
    let layer = |name: &str, mask, chlorophyll| {
        let values = PerConstituent::splat(None);
        let values = values.with(&[(Constituent::Chlorophyll, Some(chlorophyll))]);
        Layer {
            name: name.to_owned(),
            mask,
            share: 1.0,
            change: Change::Values {
                mode: Mode::Replace,
                values,
            },
        }
    };
    let rim = Mask::Margin {
        width: RimWidth::Mm(4.0),
        softness_mm: 1.0,
        wander: 0.8,
        wander_scale_mm: 6.0,
    };
    let veins = Mask::Veins {
        orders: [1, 3],
        width_mm: 0.6,
        softness_mm: 1.0,
        outside: false,
    };
    let patches = Mask::Noise {
        scale_mm: 5.0,
        threshold: 0.2,
        softness: 0.3,
        repeat_cells: None,
    };
    [
        layer("rim", rim, 5.0),
        layer("veins", veins, 60.0),
        layer("patches", patches, 20.0),
    ]
}

criterion_group!(benches, maps);
criterion_main!(benches);
