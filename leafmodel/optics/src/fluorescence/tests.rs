//! The matrices against Fluspect's way to them, against photons followed one by one, and their
//! balance.

use super::*;
use crate::quadrature::gauss;

/// From pale to dark, of one plate and of many, with other pigments that absorb.
const LEAVES: [[f64; 7]; 6] = [
    [1.0, 30.0, 8.0, 0.0, 0.0, 0.01, 0.005],
    [1.5, 40.0, 10.0, 0.0, 0.0, 0.01, 0.009],
    [1.2, 5.0, 2.0, 0.0, 0.0, 0.008, 0.004],
    [2.1, 80.0, 16.0, 1.0, 0.0, 0.02, 0.013],
    [1.7, 15.0, 6.0, 20.0, 0.3, 0.01, 0.006],
    [2.7, 100.0, 25.0, 0.0, 1.0, 0.03, 0.03],
];
const EXCITATIONS_NM: [f64; 7] = [400.0, 440.0, 480.0, 550.0, 630.0, 680.0, 720.0];
const EMISSIONS_NM: [f64; 6] = [650.0, 680.0, 690.0, 710.0, 740.0, 800.0];
const EFFICIENCY: f64 = 0.01;

fn leaf(contents: [f64; 7]) -> Leaf {
    Leaf {
        contents: Contents::prospect_d(contents),
        pigments: Pigments::default(),
        quantum_efficiency: EFFICIENCY,
        emission: EmissionSpectrum::default(),
    }
}

/// A leaf at one wavelength: the surface's transmissivity for light on it and within, the
/// mesophyll's absorption, scattering and chlorophyll's share, R and T.
#[derive(Clone, Copy, Debug)]
struct AtWavelength {
    entering: f64,
    out: f64,
    absorption: f64,
    scattering: f64,
    share: f64,
    optics: [f64; 2],
    mesophyll: Mesophyll,
}

fn at(leaf: &Leaf, nm: f64) -> AtWavelength {
    let at = ProspectD::coefficients_of(&leaf.pigments, nm);
    let optics = at.reflectance_transmittance(&leaf.contents);
    let mesophyll = Mesophyll::of(&at.interface, optics);
    AtWavelength {
        entering: at.interface.t_av_40,
        out: at.interface.transmissivity_from_inside(),
        absorption: mesophyll.absorption(),
        scattering: mesophyll.scattering(),
        share: chlorophyll_share(&at, &leaf.contents),
        optics: [optics.reflectance, optics.transmittance],
        mesophyll,
    }
}

/// Fluspect's way: thin layers of first order, doubled, then the surfaces put on. Photons back and
/// forth for φ of 1.
fn by_doubling(excited: &AtWavelength, emitted: &AtWavelength, doublings: i32) -> [f64; 2] {
    let thickness = libm::exp2(-f64::from(doublings));
    let thin = |at: &AtWavelength| {
        let t = 1.0 - (at.absorption + at.scattering) * thickness;
        [at.scattering * thickness, t]
    };
    let (mut e, mut f) = (thin(excited), thin(emitted));
    let first = 0.5 * EFFICIENCY * excited.absorption * excited.share * thickness;
    let mut matrix = [first; 2];
    let doubled = |[r, t]: [f64; 2]| {
        let once = t / (1.0 - r * r);
        [r + t * r * once, t * once]
    };
    for _ in 0..doublings {
        let [back, forth] = matrix;
        let down = e[1] / (1.0 - e[0] * e[0]);
        let up = down * e[0];
        let (into_upper, into_lower) = (down * back, forth + up * back);
        let between = 1.0 / (1.0 - f[0] * f[0]);
        matrix = [
            back + up * forth + f[1] * (into_upper + f[0] * into_lower) * between,
            down * forth + f[1] * (into_lower + f[0] * into_upper) * between,
        ];
        (e, f) = (doubled(e), doubled(f));
    }
    let [back, forth] = matrix;
    // Light inside at both surfaces, then emission between them. Of two equations that are the same
    // but for their sides, sum and difference are solved.
    let between = |[r, t]: [f64; 2], out: f64, [first, last]: [f64; 2]| {
        let within = 1.0 - out;
        let sum = (first + last) / (1.0 - within * (r + t));
        let difference = (first - last) / (1.0 - within * (r - t));
        [0.5 * (sum + difference), 0.5 * (sum - difference)]
    };
    let [down, up] = between(e, excited.out, [excited.entering, 0.0]);
    let emitted_at = [down * back + up * forth, down * forth + up * back];
    between(f, emitted.out, emitted_at).map(|inside| inside * emitted.out)
}

#[test]
fn scattering_and_absorption_give_back_reflectance_and_transmittance() {
    for contents in LEAVES {
        let leaf = leaf(contents);
        for nm in EXCITATIONS_NM.into_iter().chain(EMISSIONS_NM) {
            let at = at(&leaf, nm);
            // The two streams' equations, integrated from the lower surface up by Runge and Kutta.
            let (k, s) = (at.absorption, at.scattering);
            let slope = |[down, up]: [f64; 2]| [(k + s) * down - s * up, s * down - (k + s) * up];
            let steps = 4000;
            let h = 1.0 / f64::from(steps);
            let mut streams = [1.0, 1.0 - at.out];
            for _ in 0..steps {
                let ahead = |by: f64, [d, u]: [f64; 2]| [streams[0] + by * d, streams[1] + by * u];
                let a = slope(streams);
                let b = slope(ahead(0.5 * h, a));
                let c = slope(ahead(0.5 * h, b));
                let d = slope(ahead(h, c));
                for (i, stream) in streams.iter_mut().enumerate() {
                    *stream += h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]);
                }
            }
            let [down, up] = streams;
            let entered = down - (1.0 - at.out) * up;
            let r = 1.0 - at.entering + at.entering * at.out * up / entered;
            let t = at.entering * at.out / entered;
            let off = (r - at.optics[0]).abs().max((t - at.optics[1]).abs());
            assert!(off < 1e-9, "{contents:?} at {nm} nm: {r} {t} for {at:?}");
        }
    }
}

#[test]
fn the_integral_over_depth_is_what_fluspects_doubling_tends_to() {
    let mut greatest = [0.0_f64; 2];
    for contents in LEAVES {
        let leaf = leaf(contents);
        let found = matrices(&leaf, &EXCITATIONS_NM, &EMISSIONS_NM);
        for (e, excitation) in EXCITATIONS_NM.into_iter().enumerate() {
            let excited = at(&leaf, excitation);
            for (f, emission) in EMISSIONS_NM.into_iter().enumerate() {
                let emitted = at(&leaf, emission);
                let phi = leaf.emission.at(emission);
                let own = [found.backward[e][f], found.forward[e][f]];
                // Thin layers of first order are off by their thickness, so that two numbers of
                // doublings tell the limit.
                let [coarse, fine] = [15, 16].map(|n| by_doubling(&excited, &emitted, n));
                for ((own, coarse), fine) in own.into_iter().zip(coarse).zip(fine) {
                    let limit = phi * (2.0 * fine - coarse);
                    let off = |value: f64| (value / limit - 1.0).abs();
                    let offs = [off(own), off(phi * coarse)];
                    for (greatest, off) in greatest.iter_mut().zip(offs) {
                        *greatest = greatest.max(off);
                    }
                    assert!(
                        offs[0] < 2e-6,
                        "{contents:?} {excitation} {emission}: {offs:?}"
                    );
                }
            }
        }
    }
    eprintln!(
        "greatest deviation {:.1e}; of 15 doublings {:.1e}",
        greatest[0], greatest[1]
    );
}

#[test]
fn chlorophyll_emits_its_share_of_what_it_absorbs_and_no_photon_is_lost() {
    // Nodes enough that their error is rounding.
    let nodes = gauss(64);
    for contents in LEAVES {
        let leaf = leaf(contents);
        for nm in EXCITATIONS_NM {
            let at = at(&leaf, nm);
            // Absorbed in the leaf, from the streams at each depth.
            let absorbed: f64 = nodes
                .iter()
                .map(|(x, w)| w * at.absorption * at.entering * at.mesophyll.light_at(*x))
                .sum();
            let by_balance = 1.0 - at.optics[0] - at.optics[1];
            assert!(
                (absorbed - by_balance).abs() < 1e-9,
                "{contents:?} {nm}: {absorbed}"
            );
            let sum: f64 = at.mesophyll.absorbing().0.iter().sum();
            assert!((sum - 1.0).abs() < 1e-14);
            // At the nodes of matrices too.
            let profile = at.mesophyll.absorbing();
            let mean: f64 = profile
                .0
                .iter()
                .zip(gauss(DEPTHS))
                .map(|(a, (x, _))| a * x)
                .sum();
            let exact: f64 = nodes
                .iter()
                .map(|(x, w)| w * x * at.absorption * at.entering * at.mesophyll.light_at(*x))
                .sum::<f64>()
                / absorbed;
            assert!(
                (mean - exact).abs() < 1e-6,
                "{contents:?} {nm}: {mean} for {exact}"
            );
        }
        for nm in EMISSIONS_NM {
            let at = at(&leaf, nm);
            let (k, r) = (at.absorption, 1.0 - at.out);
            for depth in [0.03, 0.3, 0.5, 0.9] {
                // Absorbed again: streams of a source of 1 at a depth, above and below it, by the
                // reflectances of what lies above and below.
                let bounded = |thickness: f64| {
                    let [back, through] = at.mesophyll.layer(thickness);
                    back + through * through * r / (1.0 - back * r)
                };
                let (above, below) = (bounded(depth), bounded(1.0 - depth));
                let both = 0.5 / (1.0 - above * below);
                let starts = [both * (1.0 + below), both * (1.0 + above)];
                let sides = [depth, 1.0 - depth];
                let absorbed: f64 = (0..2)
                    .map(|side| {
                        // Light that goes into a layer with a surface behind it.
                        let whole = sides[side];
                        let inside: f64 = nodes
                            .iter()
                            .map(|(x, w)| {
                                let [first, rest] = [x * whole, (1.0 - x) * whole];
                                let [back, through] = at.mesophyll.layer(first);
                                let behind = bounded(rest);
                                let down = through / (1.0 - back * behind);
                                w * whole * k * down * (1.0 + behind)
                            })
                            .sum();
                        starts[side] * inside
                    })
                    .sum();
                let escaped =
                    [depth, 1.0 - depth].map(|from| 0.5 * at.out * at.mesophyll.light_at(from));
                let sum = absorbed + escaped[0] + escaped[1];
                assert!((sum - 1.0).abs() < 1e-9, "{contents:?} {nm} {depth}: {sum}");
            }
        }
    }
}

/// A generator of random numbers in [0, 1), of 64 bits that are mixed.
struct Dice(u64);

impl Dice {
    fn roll(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// What befalls a photon of a stream.
enum Fate {
    AbsorbedAt(f64),
    LeftBy(usize),
}

/// Follows a photon from a depth, down or up.
fn photon(at: &AtWavelength, mut depth: f64, mut is_down: bool, dice: &mut Dice) -> Fate {
    loop {
        let step = -libm::log(1.0 - dice.roll()) / (at.absorption + at.scattering);
        depth += if is_down { step } else { -step };
        if (0.0..=1.0).contains(&depth) {
            if dice.roll() * (at.absorption + at.scattering) < at.absorption {
                return Fate::AbsorbedAt(depth);
            }
            is_down = !is_down;
            continue;
        }
        let side = usize::from(depth > 1.0);
        if dice.roll() < at.out {
            return Fate::LeftBy(side);
        }
        (depth, is_down) = (side as f64, side == 0);
    }
}

#[test]
fn photons_followed_one_by_one_leave_as_the_matrices_say() {
    let count = 200_000;
    let mut dice = Dice(7);
    for (contents, excitation, emission) in [
        (LEAVES[1], 440.0, 685.0),
        (LEAVES[1], 550.0, 740.0),
        (LEAVES[3], 630.0, 690.0),
    ] {
        // Every photon that chlorophyll absorbs emits one, so that more can be counted.
        let leaf = Leaf {
            quantum_efficiency: 1.0,
            ..leaf(contents)
        };
        let (excited, emitted) = (at(&leaf, excitation), at(&leaf, emission));
        let mut counts = [0_u32; 4];
        for _ in 0..count {
            if dice.roll() >= excited.entering {
                continue;
            }
            let Fate::AbsorbedAt(depth) = photon(&excited, 0.0, true, &mut dice) else {
                continue;
            };
            if dice.roll() >= excited.share {
                continue;
            }
            counts[3] += 1;
            let is_down = dice.roll() < 0.5;
            let fate = photon(&emitted, depth, is_down, &mut dice);
            counts[match fate {
                Fate::LeftBy(side) => side,
                Fate::AbsorbedAt(_) => 2,
            }] += 1;
        }
        assert_eq!(counts[3], counts[0] + counts[1] + counts[2]);
        let found = matrices(&leaf, &[excitation], &[emission]);
        let phi = leaf.emission.at(emission);
        let absorbed = 1.0 - excited.optics[0] - excited.optics[1];
        let expected = [
            found.backward[0][0] / phi,
            found.forward[0][0] / phi,
            excited.share * absorbed,
        ];
        for (counted, p) in [counts[0], counts[1], counts[3]].into_iter().zip(expected) {
            let n = f64::from(count);
            let z = (f64::from(counted) - n * p) / (n * p * (1.0 - p)).sqrt();
            eprintln!(
                "{contents:?} {excitation} to {emission} nm: {counted} for {p:.5}, z {z:+.2}"
            );
            assert!(z.abs() < 4.0);
        }
    }
}

/// Chlorophyll, µg/cm², of leaves from pale to dark green.
const CHLOROPHYLLS: [f64; 8] = [4.1, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 67.5];

/// F690/F735 of the lit and of the other face, and F735 over the mean of 700 to 710 nm of the lit one, in energy.
fn shape(excitation: f64, chlorophyll: f64, emission: EmissionSpectrum) -> [f64; 3] {
    const NM: [f64; 8] = [690.0, 735.0, 700.0, 702.0, 704.0, 706.0, 708.0, 710.0];
    let carotenoids = 1.13 + 0.222 * chlorophyll;
    let leaf = Leaf {
        emission,
        ..leaf([1.5, chlorophyll, carotenoids, 0.0, 0.0, 0.01, 0.005])
    };
    let found = matrices(&leaf, &[excitation], &NM);
    let of = |matrix: &[Vec<f64>], f: usize| matrix[0][f] * energy_over_photons(excitation, NM[f]);
    let shoulder: f64 = (2..NM.len()).map(|f| of(&found.backward, f)).sum();
    [
        of(&found.backward, 0) / of(&found.backward, 1),
        of(&found.forward, 0) / of(&found.forward, 1),
        of(&found.backward, 1) * (NM.len() - 2) as f64 / shoulder,
    ]
}

#[test]
fn the_shape_follows_chlorophyll_as_published() {
    let mut all = Vec::new();
    for excitation in [440.0, 550.0, 630.0] {
        let of = |chlorophyll| shape(excitation, chlorophyll, EmissionSpectrum::default());
        let shapes = CHLOROPHYLLS.map(of);
        for (chlorophyll, [back, through, far]) in CHLOROPHYLLS.iter().zip(shapes) {
            eprintln!(
                "{excitation} nm, {chlorophyll} µg/cm²: F690/F735 {back:.3} lit, {through:.3} \
                 other, F735/F700–710 {far:.3}"
            );
            // Red light is absorbed again on its way through the leaf.
            assert!(through < back);
        }
        for pair in shapes.windows(2) {
            assert!(pair[1][1] < pair[0][1], "{excitation} nm: {pair:?}");
        }
        // Light that is absorbed at once excites what is near the face, however green the leaf is.
        for pair in shapes[..5].windows(2) {
            assert!(pair[1][0] < pair[0][0], "{excitation} nm: {pair:?}");
        }
        // Gitelson et al.: F735 over that from 700 to 710 nm is linear in the content from 4.1 to 67.5 µg/cm², r²
        // above 0.95.
        let count = CHLOROPHYLLS.len() as f64;
        let mean_x = CHLOROPHYLLS.iter().sum::<f64>() / count;
        let mean_y = shapes.iter().map(|shape| shape[2]).sum::<f64>() / count;
        let pairs = CHLOROPHYLLS.iter().zip(shapes);
        let sums = pairs.fold([0.0; 3], |[xx, xy, yy], (x, shape)| {
            let (x, y) = (x - mean_x, shape[2] - mean_y);
            [xx + x * x, xy + x * y, yy + y * y]
        });
        let determination = sums[1] * sums[1] / (sums[0] * sums[2]);
        eprintln!("{excitation} nm: r² of F735/F700–710 {determination:.3}");
        assert!(determination > 0.95, "{determination}");
        all.push(shapes);
    }
    // Lichtenthaler and Rinderle: light of 400 to 500 nm gives higher ratios than that of 525 to 633.
    for (i, blue) in all[0].iter().enumerate().skip(2) {
        assert!(blue[0] > all[1][i][0] && blue[0] > all[2][i][0]);
    }
}

#[test]
fn one_emission_spectrum_gives_both_published_ranges_in_green_leaves() {
    // Rinderle and Lichtenthaler: 0.8 to 1.1 in blue light, 0.5 to 0.7 in yellow to red light. The emission spectrum
    // is a factor on all of these ratios; whether one factor will do rests on transport alone.
    let published = [
        (440.0, [0.8, 1.1]),
        (550.0, [0.5, 0.7]),
        (630.0, [0.5, 0.7]),
    ];
    let factor_of = |emission: EmissionSpectrum| emission.at(690.0) / emission.at(735.0);
    let mut bounds = [0.0, f64::INFINITY];
    for (excitation, [least, most]) in published {
        for chlorophyll in [40.0, 50.0, 60.0] {
            let spectra = [EmissionSpectrum::default(), EmissionSpectrum::new(2.6)];
            let [own, other] = spectra
                .map(|spectrum| shape(excitation, chlorophyll, spectrum)[0] / factor_of(spectrum));
            assert!((own / other - 1.0).abs() < 1e-12);
            bounds = [bounds[0].max(least / own), bounds[1].min(most / own)];
        }
    }
    eprintln!(
        "φ(690)/φ(735) from {:.3} to {:.3} gives all",
        bounds[0], bounds[1]
    );
    let factor = factor_of(EmissionSpectrum::new(2.6));
    assert!(
        bounds[0] < factor && factor < bounds[1],
        "{bounds:?} {factor}"
    );
}
