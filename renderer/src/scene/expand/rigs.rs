//! Lights that stand as photographers set them up, as lights and objects of the scene.
//!
//! Soft boxes are rectangles with area lights, all
//! sizes and distances are multiples of the subject's size, and the light's level is that of a
//! picture with the exposure 0: a level sheet at the subject gets [`ON_PAPER`].

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DMat3, DMat4, DVec2, DVec3, DVec4};
use leafmodel::document::names::Named;

use crate::geometry::shapes::Rectangle;
use crate::light::daylight::Daylight;
use crate::light::pattern::Pattern;
use crate::scene::authored::{self, Rig, RigPreset};
use crate::scene::description::light::area::{Area, AreaPattern};
use crate::scene::description::light::constant::Constant;
use crate::scene::description::light::overcast::Overcast;
use crate::scene::description::{
    Description, Light, Material, Mesh, Object, ObjectShape, Shape, Spectrum,
};

/// Irradiance of a level sheet at the subject, of D65, W m⁻² nm⁻¹ at 560 nm. With the tone
/// `"standard"`, paper that reflects 0.8 has then 0.8 of the scale of an sRGB picture: 0.604 of the
/// light of white.
const ON_PAPER: f64 = PI * 0.604 / 0.8;

/// Wavelength at which the light of a day is brought to a level, nm.
const LEVEL_NM: f32 = 560.0;

/// Reflectance of the outside of soft boxes.
const CLOTH: f64 = 0.04;

/// Cells along a side of a panel over which its light is added up.
const CELLS: usize = 32;

/// Radiance of a light table over that of white.
const TABLE: f64 = 0.85;

/// A rectangle that shines.
struct Panel {
    name: &'static str,
    /// Where its middle is from the subject, in sizes of the subject: to the right as seen by the
    /// camera, away from it, and up.
    at: DVec3,
    /// Where it faces, in the same way.
    facing: DVec3,
    /// Width and height in sizes.
    size: DVec2,
    /// Radiance in the middle of the edges over that in the middle.
    edge: f64,
    /// Radiance in the middle, relative.
    radiance: f64,
}

/// A soft box that faces the subject.
fn soft_box(name: &'static str, at: [f64; 3], size: [f64; 2], radiance: f64) -> Panel {
    Panel {
        name,
        at: at.into(),
        facing: DVec3::ZERO,
        size: size.into(),
        edge: 0.5,
        radiance,
    }
}

/// A wall of a tent with its middle at `at`.
fn wall(name: &'static str, at: [f64; 3], facing: [f64; 3], radiance: f64) -> Panel {
    Panel {
        name,
        at: at.into(),
        facing: facing.into(),
        size: DVec2::splat(TENT),
        edge: 0.75,
        radiance,
    }
}

/// Side of a light tent in sizes of its subject.
const TENT: f64 = 5.0;

/// The panels of a preset, and an even light from everywhere in the same relative unit.
fn panels(preset: RigPreset) -> (Vec<Panel>, f64) {
    let half = 0.5 * TENT;
    // Walls reach below the subject, to what it stands on.
    let middle = half - 1.0;
    match preset {
        RigPreset::Studio => (
            vec![
                soft_box("key", [-4.0, -2.5, 4.5], [3.0, 4.0], 1.0),
                soft_box("fill", [5.0, -3.5, 2.5], [4.0, 4.0], 0.25),
                soft_box("rim", [1.5, 4.5, 4.0], [3.0, 1.5], 0.9),
            ],
            0.02,
        ),
        RigPreset::Tent => (
            vec![
                wall("left", [-half, 0.0, middle], [0.0, 0.0, middle], 1.0),
                wall("right", [half, 0.0, middle], [0.0, 0.0, middle], 0.7),
                wall("back", [0.0, half, middle], [0.0, 0.0, middle], 0.6),
                wall("roof", [0.0, 0.0, middle + half], [0.0, 0.0, 0.0], 0.9),
            ],
            0.1,
        ),
        RigPreset::Lightbox => (
            vec![soft_box("lamp", [-3.0, -1.5, 5.0], [4.0, 4.0], 1.0)],
            0.05,
        ),
        RigPreset::Overcast | RigPreset::GoldenHour | RigPreset::ForestEdge => (Vec::new(), 0.0),
    }
}

/// The camera's view of the subject: to the right, away and up.
struct RigStage {
    subject: DVec3,
    size: f64,
    axes: DMat3,
    /// Azimuth in which the camera looks, rad.
    azimuth: f64,
}

impl RigStage {
    fn new(scene: &Description, rig: &Rig) -> Self {
        let view = &scene.camera.view;
        let axes = view.axes();
        // A camera that looks straight down has its upper border ahead.
        let level = |v: DVec3| DVec3::new(v.x, v.y, 0.0);
        let looks = level(axes.z_axis);
        let ahead = if looks.length_squared() > 1e-12 {
            looks
        } else {
            level(axes.y_axis)
        };
        let seen = libm::atan2(ahead.y, ahead.x);
        let azimuth = rig.azimuth.unwrap_or(seen);
        let (sin, cos) = libm::sincos(azimuth);
        let away = DVec3::new(cos, sin, 0.0);
        Self {
            subject: rig.subject.unwrap_or(view.look_at),
            size: rig.size,
            axes: DMat3::from_cols(away.cross(DVec3::Z), away, DVec3::Z),
            azimuth,
        }
    }

    fn at(&self, place: DVec3) -> DVec3 {
        self.subject + self.axes * (place * self.size)
    }

    /// The frame of a panel, whose z is where it shines.
    fn frame(&self, panel: &Panel) -> DMat4 {
        let middle = self.at(panel.at);
        let z = (self.at(panel.facing) - middle).normalize();
        let x = DVec3::Z.cross(z).try_normalize();
        let x = x.unwrap_or(self.axes.x_axis);
        let y = z.cross(x);
        DMat4::from_cols(
            x.extend(0.0),
            y.extend(0.0),
            z.extend(0.0),
            middle.extend(1.0),
        )
    }

    /// Whether a panel cuts the line from the subject to a point, or along a direction if the last
    /// number is 0.
    fn is_cut(&self, panel: &Panel, towards: DVec4) -> bool {
        let to_panel = self.frame(panel).inverse();
        let start = to_panel.transform_point3(self.subject);
        let end = to_panel * towards;
        let (step, is_point) = if towards.w == 0.0 {
            (end.truncate(), false)
        } else {
            (end.truncate() - start, true)
        };
        let t = -start.z / step.z;
        let reach = if is_point { 1.0 } else { f64::INFINITY };
        let met = (start + t * step).truncate().abs();
        t > 0.0 && t < reach && met.cmple(0.5 * self.size * panel.size).all()
    }

    /// Share of an even light from everywhere that reaches a level sheet between panels.
    fn open_share(&self, panels: &[Panel]) -> f64 {
        let mut open = 0;
        for i in 0..CELLS * CELLS {
            let [u, v] = [i % CELLS, i / CELLS].map(|i| (i as f64 + 0.5) / CELLS as f64);
            let (sin, cos) = libm::sincos(2.0 * PI * v);
            // Directions by the cosine of their angle from the normal.
            let level = u.sqrt();
            let towards = DVec4::new(level * cos, level * sin, (1.0 - u).sqrt(), 0.0);
            open += usize::from(!panels.iter().any(|panel| self.is_cut(panel, towards)));
        }
        open as f64 / (CELLS * CELLS) as f64
    }

    /// Irradiance of a level sheet at the subject by a panel of the radiance 1.
    fn irradiance(&self, panel: &Panel) -> f64 {
        let frame = self.frame(panel);
        let size = panel.size * self.size;
        let pattern = Pattern::new(panel.edge, None);
        let mut sum = 0.0;
        for i in 0..CELLS * CELLS {
            let cell = DVec2::new((i % CELLS) as f64 + 0.5, (i / CELLS) as f64 + 0.5);
            let uv = cell / CELLS as f64;
            let point = frame.transform_point3(((uv - 0.5) * size).extend(0.0));
            let to_panel = point - self.subject;
            let distance2 = to_panel.length_squared();
            let cosines = to_panel.z.max(0.0) * -to_panel.dot(frame.z_axis.truncate());
            let bell = f64::from(pattern.brightness(uv.as_vec2()));
            sum += bell * cosines.max(0.0) / (distance2 * distance2);
        }
        sum * size.x * size.y / (CELLS * CELLS) as f64
    }
}

/// The name of the rig that a light of this name is a part of: names in a file have no points.
pub(in crate::scene) fn of_part(light: &str) -> Option<&str> {
    light.split_once('.').map(|(rig, _)| rig)
}

/// Adds lights to a scene, of a rig its lights and objects.
pub(super) fn set_up(scene: &mut Description, lights: Vec<Named<authored::Light>>) {
    for Named { name, value } in lights {
        let rig = match value {
            authored::Light::Single(value) => {
                scene.lights.push(Named { name, value });
                continue;
            }
            authored::Light::Rig(rig) => rig,
        };
        let stage = RigStage::new(scene, &rig);
        let level = ON_PAPER * libm::exp2(rig.ev);
        match rig.preset {
            RigPreset::Studio | RigPreset::Tent | RigPreset::Lightbox => {
                build(scene, &name, rig.preset, &stage, level);
            }
            RigPreset::Overcast => add(
                scene,
                &name,
                "sky",
                Light::Overcast(Overcast {
                    irradiance: Spectrum::D65 { scale: level },
                    ground_albedo: 0.2,
                }),
            ),
            RigPreset::GoldenHour => {
                // Before the camera, to the left: leaves are lit from behind.
                let day = day(6.0, stage.azimuth + 40_f64.to_radians(), 3.5);
                add(scene, &name, "day", Light::Daylight(levelled(day, level)));
            }
            RigPreset::ForestEdge => {
                // The forest stands behind the subject; the sun on the open side, high.
                let mut day = day(40.0, stage.azimuth + 1.25 * FRAC_PI_2, 2.5);
                day.forest = Some(stage.azimuth);
                add(scene, &name, "day", Light::Daylight(levelled(day, level)));
            }
        }
    }
}

/// A day with the sun at these angles.
fn day(elevation_deg: f64, azimuth: f64, turbidity: f64) -> Daylight {
    let mut day = Daylight {
        elevation: elevation_deg.to_radians(),
        azimuth,
        ..Daylight::default()
    };
    day.atmosphere.turbidity = turbidity;
    day
}

/// A day whose sun and sky give a level sheet this irradiance at 560 nm.
fn levelled(day: Daylight, level: f64) -> Daylight {
    let (sun, sky) = Daylight {
        forest: None,
        ..day
    }
    .lights();
    let direct = f64::from(sun.irradiance().at(LEVEL_NM)) * libm::sin(day.elevation);
    let scale = level / (direct + f64::from(sky.diffuse().at(LEVEL_NM)));
    Daylight { scale, ..day }
}

/// Adds the panels and the even light of a preset.
fn build(scene: &mut Description, rig: &str, preset: RigPreset, stage: &RigStage, level: f64) {
    let (mut panels, even) = panels(preset);
    // A tent is open where the camera looks in, from wherever that is.
    let camera = scene.camera.view.position.extend(1.0);
    panels.retain(|panel| !stage.is_cut(panel, camera));
    let lit = panels
        .iter()
        .map(|panel| panel.radiance * stage.irradiance(panel));
    let unit = level / (lit.sum::<f64>() + PI * even * stage.open_share(&panels));
    scene.materials.push(Named {
        name: format!("{rig}.cloth"),
        value: Material::matt(Spectrum::Constant(CLOTH)),
    });
    let cloth = scene.materials.len() - 1;
    for panel in panels {
        let radiance = panel.radiance * unit;
        hang(scene, rig, stage, &panel, cloth, radiance);
    }
    if preset == RigPreset::Lightbox {
        let table = Panel {
            name: "table",
            at: DVec3::new(0.0, 0.0, -0.6),
            facing: DVec3::ZERO,
            size: DVec2::splat(8.0),
            edge: 1.0,
            radiance: 1.0,
        };
        hang(scene, rig, stage, &table, cloth, TABLE * level / ON_PAPER);
    }
    let radiance = Spectrum::D65 { scale: even * unit };
    add(scene, rig, "room", Light::Constant(Constant { radiance }));
}

/// Adds a panel with the radiance in its middle.
fn hang(
    scene: &mut Description,
    rig: &str,
    stage: &RigStage,
    panel: &Panel,
    cloth: usize,
    radiance: f64,
) {
    let name = format!("{rig}.{}", panel.name);
    let size = panel.size * stage.size;
    scene.meshes.push(Named {
        name: name.clone(),
        value: Shape::Mesh(Mesh::Rectangle(Rectangle {
            width: size.x,
            height: size.y,
        })),
    });
    let shape = ObjectShape::Mesh {
        mesh: scene.meshes.len() - 1,
        material: cloth,
    };
    scene.objects.push(Named {
        name,
        value: Object {
            shapes: vec![shape],
            to_world: stage.frame(panel),
            ..Object::default()
        },
    });
    let light = Area {
        object: scene.objects.len() - 1,
        radiance: Spectrum::D65 { scale: radiance },
        pattern: AreaPattern {
            edge: panel.edge,
            ..AreaPattern::default()
        },
    };
    add(scene, rig, panel.name, Light::Area(light));
}

fn add(scene: &mut Description, rig: &str, part: &str, value: Light) {
    scene.lights.push(Named {
        name: format!("{rig}.{part}"),
        value,
    });
}

#[cfg(test)]
mod tests;
