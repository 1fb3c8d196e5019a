use optics::presets;

use super::*;
use crate::bsdf::leaf::Coat;
use crate::material::held::Held;
use crate::material::leaf::{LeafMaterial, LeafTissue};

const SIZE: usize = 64;

fn green() -> Contents {
    presets::by_name("sun-green").expect("a preset").contents
}

/// A pale vein of `width` texels down the middle of a green map.
fn veined(width: usize) -> ContentsTexture {
    let pale = green().with(&[
        (Constituent::Chlorophyll, 4.0),
        (Constituent::Carotenoids, 1.0),
    ]);
    let first = (SIZE - width) / 2;
    let texels = (0..SIZE * SIZE).map(|i| {
        let is_vein = (first..first + width).contains(&(i % SIZE));
        if is_vein { pale } else { green() }.to_texel()
    });
    ContentsTexture::new(SIZE, SIZE, texels.collect())
}

fn at(nm: f32) -> Wavelengths<4> {
    Wavelengths::new([nm; 4])
}

/// Transmittance at a place for light that may have entered elsewhere.
fn through(
    spread: &LightSpread,
    map: &ContentsTexture,
    palette: &Palette,
    uv: Vec2,
    nm: f32,
) -> f32 {
    let wavelengths = at(nm);
    let entry = spread.entry(map, uv, &wavelengths);
    let entered = spread.entered(map, &entry, &wavelengths);
    let pile = palette.lanes(&wavelengths);
    let (_, through) = pile.with_each(&map.at(uv), &entered);
    through[0]
}

/// Mean transmittance of the columns, each looked up at many places within the middle rows.
fn columns(map: &ContentsTexture, spread: &LightSpread, nm: f32) -> Vec<f64> {
    const TRIES: usize = 4000;
    let palette = Palette::default();
    let column = |x: usize| {
        let one = |i: usize| {
            let share = (i as f32 + 0.5) / TRIES as f32;
            let uv = Vec2::new((x as f32 + 0.5) / SIZE as f32, 0.3 + 0.4 * share);
            f64::from(through(spread, map, &palette, uv, nm))
        };
        (0..TRIES).map(one).sum::<f64>() / TRIES as f64
    };
    (0..SIZE).map(column).collect()
}

fn spread(texels: f32, map: &ContentsTexture) -> LightSpread {
    let thickness = Vec2::splat(texels / SIZE as f32);
    LightSpread::new(thickness, &map.mean(), &Palette::default())
}

#[test]
fn light_spreads_less_far_where_tissue_absorbs_or_scatters_more() {
    assert!((length(1.0, 0.0) - 0.81).abs() < 1e-12);
    for pair in [(1.5, 0.0), (1.5, 0.4), (1.5, 1.5), (2.5, 1.5)].windows(2) {
        let [more, less] = [pair[0], pair[1]].map(|(n, absorbed)| length(n, absorbed));
        assert!(less < more, "{less} {more}");
    }
}

#[test]
fn a_uniform_leaf_stays_as_it_is() {
    let map = veined(0);
    let palette = Palette::default();
    let pile = palette.lanes(&at(550.0));
    let own = pile.reflectance_transmittance(&green().to_texel()).1[0];
    for i in 0..100 {
        let uv = Vec2::new(0.01 * i as f32, 0.37);
        let through = through(&spread(5.0, &map), &map, &palette, uv, 550.0);
        assert!((through - own).abs() < 1e-6);
    }
}

/// The kernel over a line: `∫ e^(−r/s) / (2π s²) dy = (x/s) K₁(x/s) / (π s)`, by quadrature.
fn over_a_line(x: f64, s: f64) -> f64 {
    let steps = 4000;
    let step = 20.0 * s / f64::from(steps);
    let each = (0..steps).map(|i| {
        let y = (f64::from(i) + 0.5) * step;
        libm::exp(-libm::hypot(x, y) / s)
    });
    each.sum::<f64>() * 2.0 * step / (std::f64::consts::TAU * s * s)
}

#[test]
fn a_vein_is_blurred_by_the_kernel_and_lets_through_as_much_as_before() {
    let map = veined(4);
    let texels = 4.0;
    for nm in [450.0, 550.0, 680.0] {
        let spread = spread(texels, &map);
        let got = columns(&map, &spread, nm);
        let pile = Palette::default().lanes(&at(nm));
        let local = |x: usize| f64::from(pile.reflectance_transmittance(&map.texels()[x]).1[0]);
        let s = f64::from(texels) * f64::from(spread.length.lanes(&at(nm)).0[0]);
        // Light that came through the vein, drawn from everywhere.
        let excess = local(SIZE / 2) - local(0);
        for (x, &found) in got.iter().enumerate().take(SIZE - 10).skip(10) {
            let shift = |column: usize| column as f64 - x as f64;
            let fine = |column: usize| {
                (0..20)
                    .map(|i| over_a_line(shift(column) - 0.475 + 0.05 * f64::from(i), s))
                    .sum::<f64>()
                    / 20.0
            };
            let share: f64 = (SIZE / 2 - 2..SIZE / 2 + 2).map(fine).sum();
            let expected = local(0) + excess * share;
            // 4000 draws of a share of at most 1: a standard error of at most 0.008 of the excess.
            let error = (found - expected).abs();
            assert!(
                error < 0.035 * excess,
                "{x} at {nm} nm: {found} for {expected}"
            );
        }
        let mean = |of: &dyn Fn(usize) -> f64| (0..SIZE).map(of).sum::<f64>() / SIZE as f64;
        let (after, before) = (mean(&|x| got[x]), mean(&local));
        assert!(
            (after / before - 1.0).abs() < 0.005,
            "{after} {before} at {nm} nm"
        );
    }
}

#[test]
fn no_light_comes_from_texels_outside_the_blade() {
    // Rows without any tissue hold nothing at all.
    let texels = (0..SIZE * SIZE).map(|i| {
        if i / SIZE < SIZE / 2 {
            green().to_texel()
        } else {
            Texel::splat(0.0)
        }
    });
    let map = ContentsTexture::new(SIZE, SIZE, texels.collect());
    let spread = LightSpread::new(Vec2::splat(0.1), &green(), &Palette::default());
    let palette = Palette::default();
    let pile = palette.lanes(&at(550.0));
    let own = pile.reflectance_transmittance(&green().to_texel()).1[0];
    for i in 0..1000 {
        let uv = Vec2::new(0.001 * i as f32, 0.49);
        let through = through(&spread, &map, &palette, uv, 550.0);
        assert!((through - own).abs() < 1e-6, "{through} {own}");
    }
}

#[test]
fn reflection_stays_sharp_and_no_light_is_won() {
    let map = veined(6);
    let coats = [Coat::new(1.45, 0.3, 0.3), Coat::new(1.45, 0.45, 0.45)];
    let leaf = |map: &ContentsTexture| {
        let held = LeafTissue::Held(Held::Map(map.clone()));
        LeafMaterial::new(held, Palette::default(), None, coats.clone())
    };
    let (sharp, soft) = (leaf(&map), leaf(&map).spreading(Vec2::splat(0.1)));
    for i in 0..2000 {
        let uv = Vec2::new((i % 50) as f32 / 50.0, i as f32 / 2000.0);
        for nm in [550.0, 800.0] {
            let lanes = |leaf: &LeafMaterial| {
                let tissue = leaf.tissue_at(uv, &at(nm));
                tissue.to_lanes().map(|lanes| lanes.0[0])
            };
            let ([r_a, r_b, ..], [own_a, own_b, t_ab, t_ba, ..]) = (lanes(&sharp), lanes(&soft));
            assert_eq!([r_a, r_b], [own_a, own_b]);
            assert!(r_a + t_ab <= 1.0 + 1e-6 && r_b + t_ba <= 1.0 + 1e-6);
        }
    }
}
