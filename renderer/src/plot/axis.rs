//! Scales from numbers to pixels, with round ticks.

/// Space beyond the outermost values, as a share of their range.
const SPACE: f64 = 0.06;
/// Numbers from these on, or below, are written as powers of ten.
const PLAIN: [f64; 2] = [1e-3, 1e5];

/// A mark on an axis.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Tick {
    /// Where it is, pixels.
    pub(crate) at: f64,
    /// What it says.
    pub(crate) label: String,
}

/// A straight or a logarithmic scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Axis {
    range: [f64; 2],
    pixels: [f64; 2],
    is_logarithmic: bool,
}

impl Axis {
    /// From the first number to the second, at these pixels.
    pub(crate) fn linear(range: [f64; 2], pixels: [f64; 2]) -> Self {
        Self {
            range: widened(range),
            pixels,
            is_logarithmic: false,
        }
    }

    /// The same by logarithms; numbers > 0.
    pub(crate) fn logarithmic(range: [f64; 2], pixels: [f64; 2]) -> Self {
        debug_assert!(range[0] > 0.0 && range[1] > 0.0);
        let [low, high] = range;
        let range = if low < high {
            range
        } else {
            [0.9 * low, 1.1 * high]
        };
        Self {
            range,
            pixels,
            is_logarithmic: true,
        }
    }

    /// A straight scale with all these numbers and some space; from 0 to 1 without any.
    pub(crate) fn around(values: impl Iterator<Item = f64>, pixels: [f64; 2]) -> Self {
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
            (low.min(value), high.max(value))
        });
        if low > high {
            return Self::linear([0.0, 1.0], pixels);
        }
        let [low, high] = widened([low, high]);
        let space = SPACE * (high - low);
        Self::linear([low - space, high + space], pixels)
    }

    /// Where a number stands, pixels; numbers beyond the ends stand at them.
    pub(crate) fn at(&self, value: f64) -> f64 {
        let [low, high] = self.range;
        let share = if self.is_logarithmic {
            libm::log(value.max(low) / low) / libm::log(high / low)
        } else {
            (value - low) / (high - low)
        };
        let [from, to] = self.pixels;
        from + share.clamp(0.0, 1.0) * (to - from)
    }

    /// Its ends, pixels.
    pub(crate) fn pixels(&self) -> [f64; 2] {
        self.pixels
    }

    /// About so many round numbers within the range, each with as many digits as tell them apart.
    pub(crate) fn ticks(&self, wanted: usize) -> Vec<Tick> {
        let values = if self.is_logarithmic {
            decades(self.range, wanted)
        } else {
            steps(self.range, wanted)
        };
        let tick = |(value, label): (f64, String)| Tick {
            at: self.at(value),
            label,
        };
        values.into_iter().map(tick).collect()
    }
}

/// A range that is not empty.
fn widened([low, high]: [f64; 2]) -> [f64; 2] {
    // Less than this is rounding.
    let least = 1e-9 * low.abs().max(high.abs());
    if high - low > least {
        return [low, high];
    }
    let half = if low == 0.0 && high == 0.0 {
        1.0
    } else {
        0.1 * low.abs().max(high.abs())
    };
    [low - half, high + half]
}

/// Multiples of 1, 2 or 5 times a power of ten.
fn steps([low, high]: [f64; 2], wanted: usize) -> Vec<(f64, String)> {
    let rough = (high - low) / wanted.max(1) as f64;
    let power = libm::floor(libm::log10(rough));
    let unit = libm::pow(10.0, power);
    let factor = [1.0, 2.0, 5.0]
        .into_iter()
        .find(|factor| factor * unit >= 0.75 * rough)
        .unwrap_or(10.0);
    let step = factor * unit;
    // The power of ten that stands beside numbers which are all large or all small.
    let size = low.abs().max(high.abs());
    let is_plain = (PLAIN[0]..PLAIN[1]).contains(&size);
    let beside = if is_plain {
        0.0
    } else {
        libm::floor(libm::log10(size))
    };
    let last_digit = libm::floor(libm::log10(step * 1.001)) - beside;
    let digits = (-last_digit).clamp(0.0, 9.0) as usize;
    let (first, last) = (
        libm::ceil(low / step - 1e-6),
        libm::floor(high / step + 1e-6),
    );
    let count = (last - first).clamp(0.0, 100.0) as usize;
    (0..=count)
        .map(|i| {
            let value = (first + i as f64) * step;
            let text = format!("{:.digits$}", value / libm::pow(10.0, beside));
            (value, with_power(&text, beside))
        })
        .collect()
}

/// 1, 2 and 5 of each decade, or 1 alone, or 1 of some decades.
fn decades([low, high]: [f64; 2], wanted: usize) -> Vec<(f64, String)> {
    let [first, last] = [low, high].map(libm::log10);
    if last - first < 0.7 {
        return steps([low, high], wanted);
    }
    let [from, to] = [libm::floor(first), libm::ceil(last)].map(|power| power as i32);
    let factors: &[f64] = if (last - first) * 3.0 <= 1.4 * wanted as f64 {
        &[1.0, 2.0, 5.0]
    } else {
        &[1.0]
    };
    let every = ((last - first) / wanted.max(1) as f64).ceil().max(1.0) as usize;
    let values = (from..=to).step_by(every).flat_map(|power| {
        let of = move |factor: &f64| factor * libm::pow(10.0, f64::from(power));
        factors.iter().map(of)
    });
    let inside = values.filter(|value| (low * 0.999..=high * 1.001).contains(value));
    inside.map(|value| (value, short(value, 1))).collect()
}

/// A number with so many significant digits, digits before the point never dropped; very large and
/// small ones with a power of ten, whole ones without a point.
pub(crate) fn short(number: f64, digits: i32) -> String {
    let size = number.abs();
    if size < PLAIN[1] && number.fract() == 0.0 {
        return with_power(&format!("{number:.0}"), 0.0);
    }
    let power = libm::floor(libm::log10(size));
    if (PLAIN[0]..PLAIN[1]).contains(&size) {
        let after = (digits - 1 - power as i32).max(0) as usize;
        return with_power(&format!("{number:.after$}"), 0.0);
    }
    let after = (digits - 1).max(0) as usize;
    let text = format!("{:.after$}", number / libm::pow(10.0, power));
    with_power(&text, power)
}

/// A number with a true minus, times a power of ten; 0 is 0.
fn with_power(text: &str, power: f64) -> String {
    let is_zero = text.chars().all(|letter| matches!(letter, '-' | '0' | '.'));
    let text = match text.strip_prefix('-') {
        Some(rest) if is_zero => rest.to_owned(),
        Some(rest) => format!("−{rest}"),
        None => text.to_owned(),
    };
    if is_zero && power != 0.0 {
        return "0".to_owned();
    }
    if power == 0.0 {
        return text;
    }
    let raised: String = format!("{power:.0}").chars().map(raised).collect();
    format!("{text}·10{raised}")
}

fn raised(letter: char) -> char {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    letter
        .to_digit(10)
        .map_or('⁻', |digit| DIGITS[digit as usize])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(axis: Axis, wanted: usize) -> Vec<String> {
        axis.ticks(wanted)
            .into_iter()
            .map(|tick| tick.label)
            .collect()
    }

    #[test]
    fn ticks_are_round_numbers_with_the_digits_that_they_need() {
        let linear = |low, high| labels(Axis::linear([low, high], [0.0, 100.0]), 4);
        assert_eq!(linear(0.0, 1.0), ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
        assert_eq!(linear(0.0, 0.3), ["0.0", "0.1", "0.2", "0.3"]);
        assert_eq!(linear(-3.0, 8.0), ["0", "5"]);
        assert_eq!(
            linear(1527.0, 1531.0),
            ["1527", "1528", "1529", "1530", "1531"]
        );
        assert_eq!(
            linear(0.0, 4e-6),
            ["0", "1·10⁻⁶", "2·10⁻⁶", "3·10⁻⁶", "4·10⁻⁶"]
        );
        assert_eq!(
            linear(-2e6, 2e6),
            ["−2·10⁶", "−1·10⁶", "0", "1·10⁶", "2·10⁶"]
        );
        // One value alone has a scale too.
        assert_eq!(linear(5.0, 5.0), ["4.6", "4.8", "5.0", "5.2", "5.4"]);
        assert!(labels(Axis::around(std::iter::empty(), [0.0, 1.0]), 4).len() > 2);
    }

    #[test]
    fn logarithmic_ticks_are_decades_and_parts_of_them() {
        let of = |low, high| labels(Axis::logarithmic([low, high], [0.0, 100.0]), 5);
        assert_eq!(of(0.01, 0.3), ["0.01", "0.02", "0.05", "0.1", "0.2"]);
        assert_eq!(of(0.01, 100.0), ["0.01", "0.1", "1", "10", "100"]);
        assert_eq!(of(1.0, 1.5).len(), 6);
        // Two decades with room for four: parts of them would touch.
        let few = Axis::logarithmic([1e-4, 1e-2], [0.0, 100.0]);
        assert_eq!(labels(few, 4), ["1·10⁻⁴", "0.001", "0.01"]);
        assert!(of(1e-9, 1e9).len() <= 7, "{:?}", of(1e-9, 1e9));
    }

    #[test]
    fn numbers_have_their_places_and_those_beyond_lie_at_the_ends() {
        let axis = Axis::linear([1.0, 3.0], [10.0, 30.0]);
        assert_eq!(
            [0.0, 1.0, 2.0, 9.0].map(|v| axis.at(v)),
            [10.0, 10.0, 20.0, 30.0]
        );
        let axis = Axis::logarithmic([0.1, 10.0], [0.0, 2.0]);
        assert!((axis.at(1.0) - 1.0).abs() < 1e-12);
        assert_eq!(axis.at(-1.0), 0.0);
    }

    #[test]
    fn numbers_are_short() {
        let all = [0.0, 27.0, 1234.56, 0.012345, 6.12e-5, -2.5, 123456.7];
        let wanted = [
            "0",
            "27",
            "1235",
            "0.01235",
            "6.120·10⁻⁵",
            "−2.500",
            "1.235·10⁵",
        ];
        assert_eq!(all.map(|number| short(number, 4)), wanted);
    }
}
