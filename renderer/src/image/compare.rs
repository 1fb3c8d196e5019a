//! Comparison of two pictures.

use super::picture::{Layer, Picture};

/// Comparison of two pictures.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// Width and height of both.
    pub sizes: [(u32, u32); 2],
    /// Channels that both have, in the first one's order; empty if the sizes differ.
    pub channels: Vec<ChannelComparison>,
    /// Names of channels that only the first or only the second has.
    pub missing: [Vec<String>; 2],
    /// Same size, same channels, and every value the same bit for bit. Attributes are ignored.
    pub identical: bool,
}

/// Comparison of one channel over the pixels that are finite in both pictures.
#[derive(Clone, Debug, PartialEq)]
pub struct ChannelComparison {
    /// Name of the channel.
    pub name: String,
    /// Mean of the first picture.
    pub mean_a: f64,
    /// Mean of the second picture.
    pub mean_b: f64,
    /// `(mean_b − mean_a) / mean_a`; 0 if the means are equal, infinite if only the first is 0.
    pub relative_difference: f64,
    /// Largest |b − a|.
    pub max_abs_difference: f64,
    /// Root of the mean of (b − a)².
    pub rmse: f64,
    /// Pixels left out because either value is NaN or infinite.
    pub not_finite: usize,
    /// Every value is the same bit for bit.
    pub identical: bool,
}

/// Compares two pictures, channel by channel and pixel by pixel.
pub fn compare(a: &Picture, b: &Picture) -> Comparison {
    let sizes = [a, b].map(|picture| (picture.width, picture.height));
    let only = |one: &Picture, other: &Picture| {
        let missing = one
            .layers
            .iter()
            .filter(|layer| other.layer(&layer.name).is_none());
        missing.map(|layer| layer.name.clone()).collect::<Vec<_>>()
    };
    let missing = [only(a, b), only(b, a)];
    let channels: Vec<_> = if sizes[0] == sizes[1] {
        let pairs = a
            .layers
            .iter()
            .filter_map(|layer| Some((layer, b.layer(&layer.name)?)));
        pairs.map(|(a, b)| compare_channel(a, b)).collect()
    } else {
        Vec::new()
    };
    let identical = sizes[0] == sizes[1]
        && missing.iter().all(Vec::is_empty)
        && channels.iter().all(|channel| channel.identical);
    Comparison {
        sizes,
        channels,
        missing,
        identical,
    }
}

fn compare_channel(a: &Layer, b: &Layer) -> ChannelComparison {
    let pairs = || a.data.iter().zip(&b.data);
    let finite = || {
        let finite = pairs().filter(|(a, b)| a.is_finite() && b.is_finite());
        finite.map(|(&a, &b)| (f64::from(a), f64::from(b)))
    };
    let count = finite().count();
    let mean = |sum: f64| if count == 0 { 0.0 } else { sum / count as f64 };
    let mean_a = mean(finite().map(|(a, _)| a).sum());
    let mean_b = mean(finite().map(|(_, b)| b).sum());
    let difference = mean_b - mean_a;
    ChannelComparison {
        name: a.name.clone(),
        mean_a,
        mean_b,
        relative_difference: if difference == 0.0 {
            0.0
        } else {
            difference / mean_a
        },
        max_abs_difference: finite().map(|(a, b)| (b - a).abs()).fold(0.0, f64::max),
        rmse: mean(finite().map(|(a, b)| (b - a) * (b - a)).sum()).sqrt(),
        not_finite: pairs().count() - count,
        identical: a.data.len() == b.data.len() && pairs().all(|(a, b)| a.to_bits() == b.to_bits()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(layers: &[(&str, [f32; 4])]) -> Picture {
        let layer = |&(name, data): &(&str, [f32; 4])| Layer::new(name, data.to_vec());
        Picture::new([2, 2], layers.iter().map(layer))
    }

    #[test]
    fn figures_are_those_of_the_definition() {
        let a = picture(&[("R", [1.0, 2.0, 3.0, 4.0]), ("G", [0.0; 4])]);
        let b = picture(&[("G", [0.0; 4]), ("R", [1.0, 2.0, 3.0, 6.0])]);
        let comparison = compare(&a, &b);
        assert!(!comparison.identical);
        let red = &comparison.channels[0];
        assert_eq!(
            (red.mean_a, red.mean_b, red.relative_difference),
            (2.5, 3.0, 0.2)
        );
        assert_eq!(
            (red.max_abs_difference, red.rmse, red.not_finite),
            (2.0, 1.0, 0)
        );
        assert!(!red.identical && comparison.channels[1].identical);
        assert_eq!(comparison.channels[1].relative_difference, 0.0);
    }

    #[test]
    fn identical_means_every_bit() {
        let a = picture(&[("R", [1.0, f32::NAN, -0.0, f32::INFINITY])]);
        assert!(compare(&a, &a).identical);
        assert_eq!(compare(&a, &a).channels[0].not_finite, 2);
        let zero = picture(&[("R", [1.0, f32::NAN, 0.0, f32::INFINITY])]);
        assert!(!compare(&a, &zero).identical);
    }

    #[test]
    fn other_channels_and_other_sizes_are_reported() {
        let a = picture(&[("R", [0.0; 4]), ("Z", [0.0; 4])]);
        let mut b = picture(&[("R", [0.0; 4]), ("A", [0.0; 4])]);
        let comparison = compare(&a, &b);
        assert_eq!(
            comparison.missing,
            [vec!["Z".to_owned()], vec!["A".to_owned()]]
        );
        assert!(!comparison.identical);
        (b.width, b.height) = (4, 1);
        let comparison = compare(&a, &b);
        assert!(comparison.channels.is_empty() && !comparison.identical);
        assert_eq!(comparison.sizes, [(2, 2), (4, 1)]);
    }
}
