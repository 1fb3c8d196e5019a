//! Where the sun stands at a place and time.

use std::f64::consts::{PI, TAU};

/// A moment in universal time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment {
    /// Days since 2000-01-01 12:00 UTC.
    days: f64,
    /// Day of its year, 1 to 366.
    day_of_year: u32,
    /// Hours since midnight.
    hours: f64,
}

impl Moment {
    /// The moment of a day of the Gregorian calendar, month and day from 1, with the hours since
    /// midnight UTC, which may lie outside of 0 to 24: then it is on another day.
    pub fn new(year: i32, month: u32, day: u32, hours: f64) -> Self {
        let january_first = days_from_civil(year, 1, 1);
        let day_number = days_from_civil(year, month, day);
        // 2000-01-01 has the number 10957 since 1970.
        let days = (day_number - 10957) as f64 - 0.5 + hours / 24.0;
        Self {
            days,
            day_of_year: (day_number - january_first + 1) as u32,
            hours,
        }
    }

    /// Another time of the same day, hours since midnight UTC.
    pub fn at_hours(self, hours: f64) -> Self {
        Self {
            days: self.days + (hours - self.hours) / 24.0,
            hours,
            ..self
        }
    }

    /// Day of the year, 1 to 366.
    pub fn day_of_year(self) -> u32 {
        self.day_of_year
    }
}

/// Days from 1970-01-01 to a day of the Gregorian calendar.
fn days_from_civil(year: i32, month: u32, day: u32) -> i64 {
    // Years from March, so that the leap day is the last.
    let (year, month) = (i64::from(year), i64::from(month));
    let year = if month <= 2 { year - 1 } else { year };
    let month = (month + 9) % 12;
    let leap_days = year.div_euclid(4) - year.div_euclid(100) + year.div_euclid(400);
    let before = (153 * month + 2) / 5;
    365 * year + leap_days + before + i64::from(day) - 1 - 719_468
}

/// Elevation above the horizon with refraction, and azimuth from north over east, rad, at a place
/// (latitude north and longitude east, rad). Within 0.02° from 1950 to 2050; refraction near the
/// horizon depends on the weather.
///
/// # Source
///
/// \[michalsky1988\], the Astronomical Almanac's approximation, and his refraction.
pub fn sun_position(moment: Moment, latitude: f64, longitude: f64) -> [f64; 2] {
    let n = moment.days;
    let degrees = |value: f64| value.rem_euclid(360.0).to_radians();
    let mean_longitude = degrees(280.460 + 0.985_647_4 * n);
    let anomaly = degrees(357.528 + 0.985_600_3 * n);
    let (g, g2) = (libm::sin(anomaly), libm::sin(2.0 * anomaly));
    let ecliptic = mean_longitude + (1.915 * g + 0.020 * g2).to_radians();
    let obliquity = (23.439 - 4e-7 * n).to_radians();
    let ascension = libm::atan2(
        libm::cos(obliquity) * libm::sin(ecliptic),
        libm::cos(ecliptic),
    );
    let declination = libm::asin(libm::sin(obliquity) * libm::sin(ecliptic));
    let sidereal_hours = 6.697_375 + 0.065_709_824_2 * n + moment.hours;
    let sidereal = degrees(15.0 * sidereal_hours) + longitude;
    let hour_angle = (sidereal - ascension + PI).rem_euclid(TAU) - PI;
    let (sin_d, cos_d) = libm::sincos(declination);
    let (sin_l, cos_l) = libm::sincos(latitude);
    let (sin_h, cos_h) = libm::sincos(hour_angle);
    let sin_elevation = sin_d * sin_l + cos_d * cos_l * cos_h;
    let elevation = libm::asin(sin_elevation.clamp(-1.0, 1.0));
    let azimuth = libm::atan2(-cos_d * sin_h, sin_d * cos_l - cos_d * sin_l * cos_h);
    [elevation + refraction(elevation), azimuth.rem_euclid(TAU)]
}

/// How much higher the sun appears than it is, rad.
fn refraction(elevation: f64) -> f64 {
    let e = elevation.to_degrees();
    let degrees = if e > -0.56 {
        3.51561 * (0.1594 + 0.0196 * e + 0.00002 * e * e) / (1.0 + 0.505 * e + 0.0845 * e * e)
    } else {
        0.56
    };
    degrees.to_radians()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sun_is_where_the_nrel_algorithm_has_it() {
        let table = include_str!("../../../fixtures/sun_position_reference.csv");
        let mut places = 0;
        for line in table
            .lines()
            .filter(|line| line.starts_with(|c: char| c.is_ascii_digit()))
        {
            let f: Vec<f64> = line
                .split(',')
                .map(|f| f.parse().expect("a number"))
                .collect();
            let moment = Moment::new(f[0] as i32, f[1] as u32, f[2] as u32, f[3]);
            let [elevation, azimuth] = sun_position(moment, f[4].to_radians(), f[5].to_radians());
            let off = (elevation.to_degrees() - f[7]).abs();
            // Refraction formulae differ by a few hundredths of a degree near the horizon.
            let allowed = if f[7] > 15.0 { 0.02 } else { 0.05 };
            assert!(
                off < allowed,
                "{line}: elevation {}",
                elevation.to_degrees()
            );
            let turned = (azimuth.to_degrees() - f[8] + 180.0).rem_euclid(360.0) - 180.0;
            let off = turned.abs() * libm::cos(elevation);
            assert!(off < 0.02, "{line}: azimuth {}", azimuth.to_degrees());
            places += 1;
        }
        assert_eq!(places, 10);
    }

    #[test]
    fn days_are_counted_over_leap_years() {
        assert_eq!(Moment::new(2024, 12, 31, 0.0).day_of_year(), 366);
        assert_eq!(Moment::new(1900, 12, 31, 0.0).day_of_year(), 365);
        assert_eq!(Moment::new(2000, 1, 1, 12.0).days, 0.0);
        assert_eq!(Moment::new(2000, 3, 1, 12.0).days, 60.0);
        assert_eq!(Moment::new(1999, 12, 31, 36.0).days, 0.0);
    }
}
