//! `[meshes.NAME.…]`: rectangle, sphere, box, disc, drop, lump, terrain, masonry, file, gltf.

use leafmodel::document::keys::{Keys, Variant};
use leafmodel::document::limits::Limits;
use leafmodel::document::value_kind::{Degrees, FilePath, Integer, Number, Numbers, Word};

use super::gltf::gltf;
use crate::scene::description::{Drop, Lump, Masonry, MasonryPart, Mesh, Terrain};

/// Range of the extents of shapes, m.
const EXTENTS_M: Number = Number(Limits::above(0.0, 1e6));
/// Largest mesh file that is read, bytes.
const MOST_MESH_BYTES: u64 = 4 << 30;

/// The keys of one of `[meshes]`.
pub(super) fn mesh(mesh: &mut Mesh, keys: &mut Keys<'_>) {
    keys.kind(mesh, &KINDS);
}

const KINDS: [Variant<Mesh>; 10] = [
    Variant {
        name: "rectangle",
        about: "A rectangle in the xy plane around the origin, its normal along +z.",
        new: || Mesh::Rectangle {
            width: 1.0,
            height: 1.0,
        },
        is: |mesh| matches!(mesh, Mesh::Rectangle { .. }),
        declare: |mesh, keys| {
            if let Mesh::Rectangle { width, height } = mesh {
                keys.required("width_m", width, EXTENTS_M, "Extent along x.");
                keys.required("height_m", height, EXTENTS_M, "Extent along y.");
            }
        },
    },
    Variant {
        name: "sphere",
        about: "A sphere around the origin.",
        new: Mesh::unit_sphere,
        is: |mesh| matches!(mesh, Mesh::Sphere { .. }),
        declare: |mesh, keys| {
            if let Mesh::Sphere { radius, segments } = mesh {
                keys.required("radius_m", radius, EXTENTS_M, "Its radius.");
                let about = "Triangles around the equator, half as many from pole to pole.";
                keys.key("segments", segments, SEGMENTS, about);
            }
        },
    },
    Variant {
        name: "box",
        about: "A closed box around the origin.",
        new: || Mesh::Box { size: [1.0; 3] },
        is: |mesh| matches!(mesh, Mesh::Box { .. }),
        declare: |mesh, keys| {
            if let Mesh::Box { size } = mesh {
                let limits = Numbers::<3>(Limits::above(0.0, 1e6));
                keys.required("size_m", size, limits, "Extent along x, y and z.");
            }
        },
    },
    Variant {
        name: "disc",
        about: "A flat disc around the origin, its normal along +z.",
        new: || Mesh::Disc {
            radius: 0.01,
            segments: 24,
        },
        is: |mesh| matches!(mesh, Mesh::Disc { .. }),
        declare: |mesh, keys| {
            if let Mesh::Disc { radius, segments } = mesh {
                keys.required(
                    "radius_m",
                    radius,
                    EXTENTS_M,
                    "Radius of a disc of its area.",
                );
                keys.key("segments", segments, SEGMENTS, "Its corners.");
            }
        },
    },
    Variant {
        name: "drop",
        about: "A drop of water that stands on z = 0.",
        new: || {
            Mesh::Drop(Drop {
                volume: 1e-9,
                contact_angle: 1.5,
                segments: 64,
            })
        },
        is: |mesh| matches!(mesh, Mesh::Drop(_)),
        declare: |mesh, keys| {
            if let Mesh::Drop(drop) = mesh {
                declare_drop(drop, keys);
            }
        },
    },
    Variant {
        name: "lump",
        about: "A pebble or crumb around the origin.",
        new: || {
            Mesh::Lump(Lump {
                radius: 0.001,
                angularity: 0.4,
                irregularity: 0.4,
                segments: 32,
                seed: 0,
            })
        },
        is: |mesh| matches!(mesh, Mesh::Lump(_)),
        declare: |mesh, keys| {
            if let Mesh::Lump(lump) = mesh {
                declare_lump(lump, keys);
            }
        },
    },
    Variant {
        name: "terrain",
        about: "Uneven ground around the origin.",
        new: || {
            Mesh::Terrain(Terrain {
                size: [1.0, 1.0],
                deviation: 0.002,
                waves: [0.2, 0.004],
                exponent: 0.7,
                seed: 0,
            })
        },
        is: |mesh| matches!(mesh, Mesh::Terrain(_)),
        declare: |mesh, keys| {
            if let Mesh::Terrain(terrain) = mesh {
                declare_terrain(terrain, keys);
            }
        },
    },
    Variant {
        name: "masonry",
        about: "A wall of bricks, or the mortar between them, that stands on z = 0 and faces +x.",
        new: || {
            Mesh::Masonry(Masonry {
                size: [1.0, 1.0],
                part: MasonryPart::Bricks,
                brick: [0.215, 0.065],
                joint: 0.01,
                recess: 0.006,
                roughness: 0.6,
                kind: [1, 1],
                seed: 0,
            })
        },
        is: |mesh| matches!(mesh, Mesh::Masonry(_)),
        declare: |mesh, keys| {
            if let Mesh::Masonry(wall) = mesh {
                declare_masonry(wall, keys);
            }
        },
    },
    Variant {
        name: "file",
        about: "The mesh of a PLY or OBJ file.",
        new: || Mesh::File {
            file: std::path::PathBuf::new(),
            scale: 1.0,
        },
        is: |mesh| matches!(mesh, Mesh::File { .. }),
        declare: |mesh, keys| {
            if let Mesh::File { file, scale } = mesh {
                const PATH: FilePath = FilePath::of(
                    "the path of a PLY or OBJ file",
                    &["ply", "obj"],
                    MOST_MESH_BYTES,
                );
                super::file(keys, "path", file, PATH, "The file.");
                keys.key("scale", scale, SCALES, "Metres per unit of the file.");
            }
        },
    },
    Variant {
        name: "gltf",
        about: "The mesh of a glTF 2.0 file, and the base colours for a material with `mesh`.",
        new: || Mesh::Gltf {
            file: std::path::PathBuf::new(),
            beside: Vec::new(),
            scale: 1.0,
        },
        is: |mesh| matches!(mesh, Mesh::Gltf { .. }),
        declare: |mesh, keys| {
            if let Mesh::Gltf {
                file,
                beside,
                scale,
            } = mesh
            {
                gltf(file, beside, keys);
                let about = "Metres per unit of the file; glTF is in metres.";
                keys.key("scale", scale, SCALES, about);
            }
        },
    },
];

/// Factors on the coordinates of files.
const SCALES: Number = Number(Limits::above(0.0, 1e6));

/// Triangles around a shape.
const SEGMENTS: Integer<u32> = Integer::within(8, 4096);
/// Most squares of uneven ground.
const MOST_SQUARES: f64 = 8e6;

fn declare_drop(drop: &mut Drop, keys: &mut Keys<'_>) {
    let mut volume_ul = 1e9 * drop.volume;
    let limits = Number(Limits::closed(1e-6, 1000.0));
    let about = "Volume; up to 1 or 2 µl gravity hardly flattens a drop of water, above it does, \
        and the shape is no longer that of water.";
    keys.required("volume_ul", &mut volume_ul, limits, about);
    drop.volume = 1e-9 * volume_ul;
    let limits = Degrees(Limits::closed(5.0, 170.0));
    let about = "Angle in the water between the leaf and the drop's side: some 40 to 90 on most \
        leaves, over 140 on those that repel it.";
    keys.key("contact_angle_deg", &mut drop.contact_angle, limits, about);
    let about = "Triangles around it, half as many from rim to top.";
    keys.key("segments", &mut drop.segments, SEGMENTS, about);
}

fn declare_lump(lump: &mut Lump, keys: &mut Keys<'_>) {
    keys.required(
        "radius_m",
        &mut lump.radius,
        EXTENTS_M,
        "Greatest distance of its faces from the middle.",
    );
    let share = || Number(Limits::closed(0.0, 1.0));
    let about = "0 is rounded by water, 1 freshly broken.";
    keys.key("angularity", &mut lump.angularity, share(), about);
    let about = "How much nearer some of its faces are than others.";
    let limits = Number(Limits::closed(0.0, 0.8));
    keys.key("irregularity", &mut lump.irregularity, limits, about);
    let about = "Triangles around it, half as many from pole to pole.";
    keys.key("segments", &mut lump.segments, SEGMENTS, about);
    let seed = Integer::within(0, u64::MAX);
    keys.key(
        "seed",
        &mut lump.seed,
        seed,
        "Same numbers and seed, same lump.",
    );
}

fn declare_terrain(terrain: &mut Terrain, keys: &mut Keys<'_>) {
    let [width, height] = &mut terrain.size;
    keys.required("width_m", width, EXTENTS_M, "Extent along x.");
    keys.required("height_m", height, EXTENTS_M, "Extent along y.");
    let mut deviation_mm = 1e3 * terrain.deviation;
    let limits = Number(Limits::closed(0.0, 1e6));
    let about = "Standard deviation of the height.";
    keys.key("deviation_mm", &mut deviation_mm, limits, about);
    terrain.deviation = 1e-3 * deviation_mm;
    let mut waves_mm = terrain.waves.map(|wave| 1e3 * wave);
    let limits = Numbers::<2>(Limits::closed(1e-3, 1e9));
    let about = "Longest and shortest wave of which the ground is made.";
    keys.key("waves_mm", &mut waves_mm, limits, about);
    terrain.waves = waves_mm.map(|wave| 1e-3 * wave);
    let limits = Number(Limits::closed(0.0, 1.0));
    let about = "Roughness exponent: 0 is as rough at all sizes, 1 smooth in the small.";
    keys.key("exponent", &mut terrain.exponent, limits, about);
    let seed = Integer::within(0, u64::MAX);
    keys.key(
        "seed",
        &mut terrain.seed,
        seed,
        "Same numbers and seed, same ground.",
    );
    if terrain.waves[0] < terrain.waves[1] {
        let problem = "the longest wave is shorter than the shortest".to_owned();
        keys.refuse(&["waves_mm"], problem, "write the longer one first");
    }
    let [across, along] = terrain.squares();
    if across * along > MOST_SQUARES {
        let problem = format!(
            "the ground would have {:.0} million squares, more than {:.0}",
            1e-6 * across * along,
            1e-6 * MOST_SQUARES
        );
        // Rounded up to two digits, so that what is told fits.
        let fits_mm = waves_mm[1] * (across * along / MOST_SQUARES).sqrt();
        let decimals = 1.0 - libm::log10(fits_mm).floor();
        let digit = libm::exp10(-decimals);
        let (fits_mm, decimals) = ((fits_mm / digit).ceil() * digit, decimals.max(0.0) as usize);
        let help =
            format!("make it smaller, or its shortest wave {fits_mm:.decimals$} mm or longer");
        keys.refuse(&["waves_mm"], problem, &help);
    }
}

fn declare_masonry(wall: &mut Masonry, keys: &mut Keys<'_>) {
    let [width, height] = &mut wall.size;
    keys.required("width_m", width, EXTENTS_M, "Extent along y.");
    keys.required("height_m", height, EXTENTS_M, "Height.");
    let parts = [
        ("bricks", MasonryPart::Bricks),
        ("mortar", MasonryPart::Mortar),
    ];
    let about = "Which part of it the mesh is.";
    keys.key("part", &mut wall.part, Word(&parts), about);
    let mut brick_mm = wall.brick.map(|extent| 1e3 * extent);
    let limits = Numbers::<2>(Limits::closed(30.0, 1e4));
    let about = "Length and height of a brick.";
    keys.key("brick_mm", &mut brick_mm, limits, about);
    wall.brick = brick_mm.map(|extent| 1e-3 * extent);
    let mut joint_mm = 1e3 * wall.joint;
    let limits = Number(Limits::closed(0.0, 1000.0));
    keys.key("joint_mm", &mut joint_mm, limits, "Width of the joints.");
    wall.joint = 1e-3 * joint_mm;
    let mut recess_mm = 1e3 * wall.recess;
    let limits = Number(Limits::closed(0.0, 1000.0));
    let about = "How far the mortar lies behind the faces of the bricks.";
    keys.key("recess_mm", &mut recess_mm, limits, about);
    wall.recess = 1e-3 * recess_mm;
    let about = "How uneven, displaced and chipped bricks are: 0 new, 1 old.";
    let limits = Number(Limits::closed(0.0, 1.0));
    keys.key("roughness", &mut wall.roughness, limits, about);
    let about = "Bricks are sorted at random into so many kinds; these are the ones of one kind: its \
        number from 1, and how many kinds there are.";
    let mut kind = wall.kind.map(f64::from);
    let limits = Numbers::<2>(Limits::closed(1.0, 16.0));
    keys.key("kind", &mut kind, limits, about);
    if kind[0] > kind[1] || kind.iter().any(|number| number.fract() != 0.0) {
        let problem = format!("there is no kind {} of {}", kind[0], kind[1]);
        let help = "write two whole numbers, such as `[1, 2]`, the first at most the second";
        keys.refuse(&["kind"], problem, help);
    }
    wall.kind = kind.map(|number| number as u32);
    let seed = Integer::within(0, u64::MAX);
    keys.key(
        "seed",
        &mut wall.seed,
        seed,
        "Same numbers and seed, same wall.",
    );
    if wall.squares() > MOST_SQUARES {
        let problem = format!(
            "the wall would have {:.0} million squares, more than {:.0}",
            1e-6 * wall.squares(),
            1e-6 * MOST_SQUARES
        );
        keys.refuse(&["width_m"], problem, "make it smaller");
    }
}

impl Mesh {
    /// A sphere with all defaults.
    pub(super) fn unit_sphere() -> Self {
        Self::Sphere {
            radius: 1.0,
            segments: 64,
        }
    }
}
