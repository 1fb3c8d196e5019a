//! `[lights.NAME.daylight]`: where the sun stands, and the air before it.

use leafmodel::document::context::QUOTED;
use leafmodel::document::declared::Declared;
use leafmodel::document::keys::Keys;
use leafmodel::document::limits::Limits;
use leafmodel::document::source::escaped;
use leafmodel::document::value_kind::{Degrees, Number, Text};
use toml::value::{Datetime, Offset};

use crate::light::daylight::spctrl2::distance_factor;
use crate::light::daylight::sun::HALF_DIAMETER;
use crate::light::daylight::sun_position::{Moment, sun_position};
use crate::light::daylight::{Daylight, ELEVATIONS_DEG};
use crate::plugin::element::Element;
use crate::plugin::emitter::Emitter;
use crate::plugin::spectra::Spectra;
use crate::scene::angle::{TURNS_DEG, declare_compass};
use crate::spectrum::written::Spectrum;

/// Years in which the position of the sun is accurate.
const YEARS: [u16; 2] = [1950, 2050];
const TIME: &str =
    "a date and time with its offset from UTC, such as \"2026-06-21T12:00:00+02:00\"";

/// The keys of the block.
pub(super) fn daylight(day: &mut Daylight, keys: &mut Keys<'_>) {
    for chosen in keys.one_of(&["elevation_deg", "time"], Some("elevation_deg")) {
        if chosen == "time" {
            place_and_time(day, keys);
        } else {
            angles(day, keys);
        }
    }
    day.atmosphere.declare(keys);
    let limits = Number(Limits::above(0.0, 1e12));
    keys.key("scale", &mut day.scale, limits, "Factor on sun and sky.");
    let limits = Degrees(Limits::closed(-360.0, 360.0));
    let about = "Direction of the middle of a forest, from +x towards +y, at whose edge the scene \
        lies: crowns before the sky there, and green ground. The sun shines past them.";
    keys.optional("forest_azimuth_deg", &mut day.forest, limits, about);
}

/// The spectrum of sun and sky on a level plane, relative.
pub(super) fn on_level_ground(day: &Daylight) -> Spectrum {
    let (sun, sky) = day.lights();
    let up = libm::sin(day.elevation);
    let points = sun.irradiance().points().into_iter();
    let points = points.map(|(nm, direct)| {
        let diffuse = f64::from(sky.diffuse().at(nm as f32));
        (nm, direct * up + diffuse)
    });
    Spectrum::Table {
        points: points.collect(),
        extrapolate: true,
    }
}

/// The disc of the sun; the sky is a part of what shines from everywhere.
pub(super) fn sun(day: &Daylight, spectra: &mut Spectra) -> Emitter<'static> {
    let irradiance = day.lights().0.irradiance().written();
    let limb = Element::plugin("texture", "lamina_sun")
        .with("name", "radiance")
        .holding(spectra.element("irradiance", &irradiance, 1.0))
        .float("half_diameter", HALF_DIAMETER);
    Emitter::Disc {
        towards: day.towards_sun(),
        half: HALF_DIAMETER,
        emitter: Element::plugin("emitter", "area").holding(limb),
    }
}

/// The sun by two angles.
fn angles(day: &mut Daylight, keys: &mut Keys<'_>) {
    let [low, high] = ELEVATIONS_DEG;
    let limits = Degrees(Limits::closed(low, high));
    let about = "Height of the sun above the horizon.";
    keys.needed("elevation_deg", &mut day.elevation, limits, about);
    let about = "Direction of the sun along the ground, from +x towards +y.";
    keys.key("azimuth_deg", &mut day.azimuth, Degrees(TURNS_DEG), about);
    if let Some(azimuth) = declare_compass(keys) {
        day.azimuth = azimuth.to_radians();
    }
    for of_a_place in ["latitude_deg", "longitude_deg", "north_azimuth_deg"] {
        keys.exclude("elevation_deg", of_a_place);
    }
}

/// The sun by place and time.
fn place_and_time(day: &mut Daylight, keys: &mut Keys<'_>) {
    let (mut time, mut latitude, mut longitude) = (String::new(), 0.0, 0.0);
    let mut north = std::f64::consts::FRAC_PI_2;
    let about = "Date and time by RFC 3339, from 1950 to 2050; `Z` at the end is UTC.";
    keys.needed("time", &mut time, Text(TIME), about);
    let limits = Degrees(Limits::closed(-90.0, 90.0));
    let about = "Latitude of the place, north is positive. It stands beside `time`.";
    keys.needed("latitude_deg", &mut latitude, limits, about);
    let limits = Degrees(Limits::closed(-180.0, 180.0));
    let about = "Longitude of the place, east is positive. It stands beside `time`.";
    keys.needed("longitude_deg", &mut longitude, limits, about);
    let limits = Degrees(Limits::closed(-360.0, 360.0));
    let about = "Where north is in the scene beside `time`, from +x towards +y: 90 is +y, so that \
        +x is east.";
    keys.key("north_azimuth_deg", &mut north, limits, about);
    keys.exclude("time", "azimuth_deg");
    keys.exclude("time", "compass_deg");
    if !keys.is_sound() {
        return;
    }
    let moment = match moment_of(&time) {
        Ok(moment) => moment,
        Err(problem) => {
            let help = format!("write {TIME}");
            return keys.refuse(&["time"], problem, &help);
        }
    };
    let [elevation, compass] = sun_position(moment, latitude, longitude);
    if elevation.to_degrees() < ELEVATIONS_DEG[0] {
        let problem = format!(
            "the sun stands at {:.1}° there and then, and daylight needs it at least {}° above \
             the horizon",
            elevation.to_degrees(),
            ELEVATIONS_DEG[0]
        );
        let help = help_for_the_dark(moment, latitude, longitude);
        return keys.refuse(&["time"], problem, &help);
    }
    day.elevation = elevation;
    day.azimuth = north - compass;
    day.atmosphere.distance_factor = distance_factor(moment.day_of_year());
}

/// Where to look for daylight when the sun does not stand high enough: near noon of that day, if
/// it does then.
fn help_for_the_dark(moment: Moment, latitude: f64, longitude: f64) -> String {
    // Within 17 minutes: the equation of time is left out.
    let minutes = (720.0 - 4.0 * longitude.to_degrees()).rem_euclid(1440.0) as u32;
    let noon = moment.at_hours(f64::from(minutes) / 60.0);
    let [highest, _] = sun_position(noon, latitude, longitude);
    if highest.to_degrees() < ELEVATIONS_DEG[0] {
        return format!(
            "choose another day or place, for at noon of that day it stands at {:.1}°; or write \
             `elevation_deg` instead",
            highest.to_degrees()
        );
    }
    format!(
        "choose another time, noon there is at about {:02}:{:02} UTC; or write `elevation_deg` \
         instead",
        minutes / 60,
        minutes % 60
    )
}

/// The moment of a time as written; what is wrong with it otherwise.
fn moment_of(text: &str) -> Result<Moment, String> {
    let written = escaped(text, QUOTED);
    let parsed: Datetime = text
        .parse()
        .map_err(|error| format!("\"{written}\" is no date and time ({error})"))?;
    let (Some(date), Some(time)) = (parsed.date, parsed.time) else {
        return Err(format!("\"{written}\" lacks the date or the time of day"));
    };
    let ahead_minutes = match parsed.offset {
        Some(Offset::Z) => 0,
        Some(Offset::Custom { minutes }) => minutes,
        None => return Err(format!("\"{written}\" has no offset from UTC")),
    };
    if date.year < YEARS[0] || date.year > YEARS[1] {
        return Err(format!(
            "the year is {}, outside {} to {}",
            date.year, YEARS[0], YEARS[1]
        ));
    }
    let seconds = f64::from(time.second.unwrap_or(0));
    let minutes = f64::from(time.minute) - f64::from(ahead_minutes);
    let hours = f64::from(time.hour) + minutes / 60.0 + seconds / 3600.0;
    let [month, day] = [date.month, date.day].map(u32::from);
    Ok(Moment::new(i32::from(date.year), month, day, hours))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_moment_is_the_same_however_far_its_clock_is_from_utc() {
        let utc = moment_of("2026-06-21T23:30:00Z").expect("it is a time");
        for same in [
            "2026-06-22T01:30:00+02:00",
            "2026-06-21T13:30:00.00-10:00",
            "2026-06-21 23:30:00z",
        ] {
            let other = moment_of(same).expect("it is a time");
            let [one, two] = [utc, other].map(|moment| sun_position(moment, 1.1, -0.4));
            assert!(
                one.iter().zip(two).all(|(a, b)| (a - b).abs() < 1e-9),
                "{same}"
            );
        }
    }

    #[test]
    fn noon_is_named_only_where_the_sun_is_high_enough_then() {
        let svalbard = [78.2_f64, 15.6].map(f64::to_radians);
        let help = |time| {
            let moment = moment_of(time).expect("it is a time");
            help_for_the_dark(moment, svalbard[0], svalbard[1])
        };
        let in_march = help("2026-03-29T23:00:00Z");
        assert!(
            in_march.contains("noon there is at about 10:57 UTC"),
            "{in_march}"
        );
        // 90° - 78.2° - 23.4° = -11.6°, and refraction lifts it by half a degree.
        let in_december = help("2026-12-21T12:00:00+01:00");
        assert!(
            in_december.contains("at noon of that day it stands at -11"),
            "{in_december}"
        );
    }

    #[test]
    fn a_time_that_is_none_is_distinguished() {
        for (text, part) in [
            ("2026-02-29T12:00:00Z", "is no date and time"),
            ("noon", "is no date and time"),
            ("2026-06-21T12:00:00", "has no offset from UTC"),
            ("2026-06-21", "lacks the date or the time"),
            ("12:00:00", "lacks the date or the time"),
            ("1949-12-31T12:00:00Z", "outside 1950 to 2050"),
        ] {
            let problem = moment_of(text).expect_err(text);
            assert!(problem.contains(part), "{text}: {problem}");
        }
    }
}
