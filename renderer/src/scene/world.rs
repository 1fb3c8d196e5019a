//! The finished scene: immutable, shared by every thread.

use std::path::PathBuf;
use std::sync::Arc;

use glam::{DAffine3, DMat4, DVec3, Vec2, Vec3};
use leafmodel::optics::solid::ReflectanceTable;
use rayon::prelude::*;
use thiserror::Error;

use crate::bsdf::dielectric::Dielectric;
use crate::bsdf::leaf::Coat;
use crate::camera::Camera;
use crate::camera::filter::PixelFilter;
use crate::geometry::{Geometry, GeometryError, ImportError, Instance, MeshError, TriangleMesh};
use crate::light::Light;
use crate::light::area::AreaLight;
use crate::light::distant::DistantLight;
use crate::light::environment::EnvironmentLight;
use crate::light::selection::LightSelection;
use crate::material::Material;
use crate::material::leaf::{LeafMaterial, LeafTissue};
use crate::material::solid::{ReflectanceTables, SolidMaterial, SolidTissue};
use crate::scene::assets::{self, AssetError};
use crate::scene::description::{self, Description, FilmKind, ObjectShape};
use crate::scene::plants::{self, Piece, PlantError, SolidError};
use crate::spectrum::wavelengths::VisibleDistribution;
use crate::spectrum::{Curve, WavelengthSampler};

/// Everything that paths meet.
#[derive(Debug)]
pub struct World {
    /// Surfaces; the first instances are the scene's objects, or of each leaf one part. The others are the rest of its parts.
    pub geometry: Geometry,
    /// What each instance is made of and whether it shines.
    pub objects: Vec<WorldObject>,
    /// Materials: the scene's, then those of each grown leaf, then that of each grown body.
    pub materials: Vec<Material>,
    /// Whose each material is.
    pub owners: Vec<MaterialOwner>,
    /// Lights, in the scene's order.
    pub lights: Vec<Light>,
    /// How lights are sampled.
    pub selection: LightSelection,
    /// Where the scene is seen from.
    pub camera: Camera,
    /// Where in a pixel samples fall.
    pub filter: PixelFilter,
    /// How long paths get.
    pub integrator: description::Integrator,
    /// What paths carry.
    pub wavelengths: WavelengthSampler,
    /// Notes for the person who renders: dropped faces, clamped reflectance.
    pub notes: Vec<String>,
}

/// Whose a material is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MaterialOwner {
    /// That of the scene with this number.
    Scene(usize),
    /// That of the leaf with the number `leaf`; its different blades have the first parts, stalks the last.
    Leaf {
        /// Index into [`Description::leaves`].
        leaf: usize,
        /// Which of its materials.
        part: usize,
    },
    /// That of the body of solid tissue with this number.
    Solid(usize),
}

/// An instance as paths see it.
#[derive(Clone, Copy, Debug)]
pub struct WorldObject {
    /// Number of the object in the scene.
    pub object: usize,
    /// Number of its material.
    pub material: usize,
    /// Number of the light that it is, if it shines.
    pub light: Option<usize>,
}

/// Why a described scene cannot be built.
#[derive(Debug, Error)]
pub enum WorldError {
    /// A mesh of the scene is no mesh.
    #[error("meshes.{name}: {source}")]
    Mesh {
        /// Name in the scene.
        name: String,
        /// What is wrong with it.
        source: MeshError,
    },
    /// A mesh file cannot be understood.
    #[error("meshes.{name}: {file}: {source}")]
    Import {
        /// Name in the scene.
        name: String,
        /// The file.
        file: PathBuf,
        /// What is wrong with it.
        source: ImportError,
    },
    /// A file cannot be read or holds something else.
    #[error("{place}: {source}")]
    Asset {
        /// Block of the scene that names it.
        place: String,
        /// What is wrong with it.
        source: AssetError,
    },
    /// A leaf cannot be grown.
    #[error("leaves.{name}: {source}")]
    Plant {
        /// Name in the scene.
        name: String,
        /// Why.
        source: Box<PlantError>,
    },
    /// A body of solid tissue cannot be grown.
    #[error("solids.{name}: {source}")]
    Solid {
        /// Name in the scene.
        name: String,
        /// Why.
        source: Box<SolidError>,
    },
    /// The geometry as a whole cannot be built.
    #[error(transparent)]
    Geometry(#[from] GeometryError),
}

impl World {
    /// Builds what a scene describes: reads meshes and pictures, grows leaves, builds the trees.
    ///
    /// # Errors
    ///
    /// [`WorldError`], which names the block of the scene.
    pub fn build(scene: &Description) -> Result<Self, WorldError> {
        let mut notes = Vec::new();
        let mut meshes = Vec::new();
        for mesh in &scene.meshes {
            let built = build_mesh(&mesh.name, &mesh.value)?;
            if built.dropped().total() > 0 {
                let dropped = built.dropped();
                notes.push(format!(
                    "meshes.{}: {} faces left out ({} not finite, {} without area, {} duplicate)",
                    mesh.name,
                    dropped.total(),
                    dropped.not_finite,
                    dropped.degenerate,
                    dropped.duplicate
                ));
            }
            meshes.push(built);
        }
        let wavelengths = wavelength_sampler(&scene.film.kind);
        let range_nm = wavelengths.range_nm();
        let (mut materials, mut tables) = (Vec::new(), ReflectanceTables::default());
        for material in &scene.materials {
            materials.push(build_material(
                &material.name,
                &material.value,
                &mut tables,
            )?);
        }
        let tables: Vec<_> = scene
            .solids
            .iter()
            .map(|solid| tables.of(solid.value.optics.tissue.eta))
            .collect();
        let mut owners: Vec<MaterialOwner> =
            (0..materials.len()).map(MaterialOwner::Scene).collect();
        let (grown_leaves, grown_solids) =
            rayon::join(|| grow_leaves(scene), || grow_solids(scene, tables));
        // Of each leaf its pieces, with the numbers that meshes and materials have in the scene.
        let mut leaves: Vec<Vec<Piece>> = Vec::new();
        for (number, grown) in grown_leaves?.into_iter().enumerate() {
            let pieces = grown.pieces.into_iter().map(|piece| Piece {
                mesh: meshes.len() + piece.mesh,
                material: materials.len() + piece.material,
                ..piece
            });
            leaves.push(pieces.collect());
            meshes.extend(grown.meshes);
            for (part, material) in grown.materials.into_iter().enumerate() {
                let leaf = number;
                owners.push(MaterialOwner::Leaf { leaf, part });
                materials.push(Material::Leaf(Box::new(material)));
            }
        }
        let mut solids = Vec::new();
        for (number, (mesh, material)) in grown_solids?.into_iter().enumerate() {
            solids.push(Piece {
                mesh: meshes.len(),
                material: materials.len(),
                to_leaf: DAffine3::IDENTITY,
            });
            meshes.push(mesh);
            owners.push(MaterialOwner::Solid(number));
            materials.push(Material::Solid(Box::new(material)));
        }
        notes.extend(notes_on_coats(scene, &materials, &owners, range_nm));
        let (instances, mut objects) = place(scene, &leaves, &solids);
        let mut lights = Vec::new();
        for (number, light) in scene.lights.iter().enumerate() {
            if let description::Light::Area { object, .. } = light.value {
                objects[object].light = Some(number);
            }
            lights.push(build_light(&light.name, &light.value, &meshes, &instances)?);
        }
        let geometry = Geometry::build(meshes, instances)?;
        let (low, high) = geometry.bounds();
        let radius = 0.5 * (high - low).length();
        let powers: Vec<f32> = lights
            .iter()
            .map(|light| power(light, radius, range_nm))
            .collect();
        Ok(Self {
            geometry,
            objects,
            materials,
            owners,
            selection: LightSelection::new(&lights, &powers),
            lights,
            camera: Camera::new(&scene.camera, scene.film.width, scene.film.height),
            filter: PixelFilter::new(scene.film.filter_radius as f32),
            integrator: scene.integrator,
            wavelengths,
            notes,
        })
    }

    /// The material of an instance.
    pub fn material_of(&self, object: u32) -> &Material {
        &self.materials[self.objects[object as usize].material]
    }
}

/// Grows the scene's leaves.
fn grow_leaves(scene: &Description) -> Result<Vec<plants::GrownLeaf>, WorldError> {
    let grown = scene.leaves.iter().map(|leaf| {
        plants::grow(&leaf.value).map_err(|source| WorldError::Plant {
            name: leaf.name.clone(),
            source: Box::new(source),
        })
    });
    grown.collect()
}

/// Grows the scene's bodies of solid tissue, each with the table of its refractive index.
fn grow_solids(
    scene: &Description,
    tables: Vec<Arc<ReflectanceTable>>,
) -> Result<Vec<(TriangleMesh, SolidMaterial)>, WorldError> {
    let grown = scene.solids.par_iter().zip(tables).map(|(solid, table)| {
        plants::grow_solid(&solid.value, table).map_err(|source| WorldError::Solid {
            name: solid.name.clone(),
            source: Box::new(source),
        })
    });
    grown.collect()
}

/// Tells of leaves and solid tissue whose coat reflects more than the whole should, each once.
fn notes_on_coats(
    scene: &Description,
    materials: &[Material],
    owners: &[MaterialOwner],
    range_nm: [f64; 2],
) -> Vec<String> {
    let mut notes: Vec<(String, String)> = Vec::new();
    for (material, owner) in materials.iter().zip(owners) {
        let (exceeds, what) = match material {
            Material::Leaf(leaf) => {
                let what = ["the adaxial coat", "the leaf"];
                (leaf.coat_exceeds_reflectance(range_nm), what)
            }
            Material::Solid(solid) => {
                let what = ["the coat", "the solid tissue"];
                (solid.coat_exceeds_reflectance(range_nm), what)
            }
            Material::Diffuse(_) | Material::Dielectric(_) => continue,
        };
        let [coat, whole] = what;
        if let Some(nm) = exceeds {
            let name = match owner {
                MaterialOwner::Scene(number) => {
                    format!("materials.{}", scene.materials[*number].name)
                }
                MaterialOwner::Leaf { leaf, .. } => format!("leaves.{}", scene.leaves[*leaf].name),
                MaterialOwner::Solid(solid) => format!("solids.{}", scene.solids[*solid].name),
            };
            if notes.last().is_some_and(|(before, _)| *before == name) {
                continue;
            }
            let note = format!(
                "{name}: at {nm} nm {coat} alone reflects more than {whole} should; \
                 {whole} reflects the coat's share there (lower the coat's eta)"
            );
            notes.push((name, note));
        }
    }
    notes.into_iter().map(|(_, note)| note).collect()
}

/// Instances, and what they are: one of each object, in their order, then the other parts of leaves.
fn place(
    scene: &Description,
    leaves: &[Vec<Piece>],
    solids: &[Piece],
) -> (Vec<Instance>, Vec<WorldObject>) {
    let (mut instances, mut objects) = (Vec::new(), Vec::new());
    let mut put = |object: usize, mesh: usize, material: usize, to_world: DMat4| {
        instances.push(Instance {
            mesh: mesh as u32,
            to_world: glam::Affine3A::from_mat4(to_world.as_mat4()),
        });
        objects.push(WorldObject {
            object,
            material,
            light: None,
        });
    };
    let put_piece =
        |put: &mut dyn FnMut(usize, usize, usize, DMat4), object: usize, piece: &Piece| {
            let to_world = scene.objects[object].value.to_world * DMat4::from(piece.to_leaf);
            put(object, piece.mesh, piece.material, to_world);
        };
    let mut rest = Vec::new();
    for (number, object) in scene.objects.iter().enumerate() {
        match object.value.shape {
            ObjectShape::Mesh { mesh, material } => {
                put(number, mesh, material, object.value.to_world);
            }
            ObjectShape::Leaf { leaf } => {
                let (first, others) = leaves[leaf].split_first().expect("a leaf has a blade");
                put_piece(&mut put, number, first);
                rest.extend(others.iter().map(|piece| (number, piece)));
            }
            ObjectShape::Solid { solid } => put_piece(&mut put, number, &solids[solid]),
        }
    }
    for (number, piece) in rest {
        put_piece(&mut put, number, piece);
    }
    (instances, objects)
}

/// What a film of this kind makes paths carry.
pub fn wavelength_sampler(kind: &FilmKind) -> WavelengthSampler {
    match kind {
        FilmKind::Rgb { range_nm } => WavelengthSampler::Rgb(VisibleDistribution::new(*range_nm)),
        FilmKind::Spectral { bands } => WavelengthSampler::Bands(bands.clone()),
    }
}

fn build_mesh(name: &str, mesh: &description::Mesh) -> Result<TriangleMesh, WorldError> {
    let named = |source| WorldError::Mesh {
        name: name.to_owned(),
        source,
    };
    match mesh {
        description::Mesh::Rectangle { width, height } => {
            let (x, y) = (0.5 * *width as f32, 0.5 * *height as f32);
            let corners = [(-x, -y), (x, -y), (x, y), (-x, y)];
            TriangleMesh::new(
                corners.map(|(x, y)| Vec3::new(x, y, 0.0)).to_vec(),
                None,
                Some(vec![Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y]),
                vec![[0, 1, 2], [0, 2, 3]],
            )
            .map_err(named)
        }
        description::Mesh::Sphere { radius, segments } => sphere(*radius, *segments).map_err(named),
        description::Mesh::File { file, scale } => {
            let bytes = assets::read(file).map_err(|source| WorldError::Asset {
                place: format!("meshes.{name}"),
                source,
            })?;
            let extension = file
                .extension()
                .and_then(|ending| ending.to_str())
                .unwrap_or("");
            crate::geometry::import(&bytes, extension, *scale as f32).map_err(|source| {
                WorldError::Import {
                    name: name.to_owned(),
                    file: file.clone(),
                    source,
                }
            })
        }
    }
}

/// A sphere of longitude–latitude triangles whose vertices lie on it, with its exact normals.
fn sphere(radius: f64, segments: u32) -> Result<TriangleMesh, MeshError> {
    let rings = (segments / 2).max(2);
    let mut normals = Vec::new();
    let mut uvs = Vec::new();
    for ring in 0..=rings {
        let (sin_theta, cos_theta) =
            libm::sincos(std::f64::consts::PI * f64::from(ring) / f64::from(rings));
        for segment in 0..=segments {
            let (sin_phi, cos_phi) =
                libm::sincos(std::f64::consts::TAU * f64::from(segment) / f64::from(segments));
            // South first, so that v grows with z.
            let normal = DVec3::new(sin_theta * cos_phi, sin_theta * sin_phi, -cos_theta);
            normals.push(normal.as_vec3());
            uvs.push(Vec2::new(
                segment as f32 / segments as f32,
                ring as f32 / rings as f32,
            ));
        }
    }
    let mut triangles = Vec::new();
    for ring in 0..rings {
        for segment in 0..segments {
            let lower = ring * (segments + 1) + segment;
            let upper = lower + segments + 1;
            if ring > 0 {
                triangles.push([lower, lower + 1, upper + 1]);
            }
            if ring + 1 < rings {
                triangles.push([lower, upper + 1, upper]);
            }
        }
    }
    let positions = normals
        .iter()
        .map(|&normal| normal * radius as f32)
        .collect();
    TriangleMesh::new(positions, Some(normals), Some(uvs), triangles)
}

fn build_material(
    name: &str,
    material: &description::Material,
    tables: &mut ReflectanceTables,
) -> Result<Material, WorldError> {
    let contents_map = |file| {
        assets::contents_map(file).map_err(|source| WorldError::Asset {
            place: format!("materials.{name}"),
            source,
        })
    };
    Ok(match material {
        description::Material::Diffuse { reflectance } => {
            Material::Diffuse(Curve::from_description(reflectance))
        }
        description::Material::Dielectric { eta, roughness } => Material::Dielectric(Dielectric {
            eta: *eta as f32,
            alpha: *roughness as f32,
        }),
        description::Material::Leaf {
            tissue,
            abaxial_ratio,
            coats,
        } => {
            let tissue = match tissue {
                description::LeafTissue::Contents { contents, .. } => {
                    LeafTissue::Uniform(*contents)
                }
                description::LeafTissue::Map { file, .. } => LeafTissue::Map(contents_map(file)?),
                description::LeafTissue::Measured {
                    reflectance,
                    transmittance,
                } => LeafTissue::Measured {
                    reflectance: Curve::from_description(reflectance),
                    transmittance: Curve::from_description(transmittance),
                },
            };
            Material::Leaf(Box::new(LeafMaterial {
                tissue,
                abaxial_ratio: Curve::from_description(abaxial_ratio),
                coats: coats.map(build_coat),
            }))
        }
        description::Material::Solid { tissue, optics } => {
            let tissue = match tissue {
                description::SolidTissue::Contents { contents, .. } => {
                    SolidTissue::Uniform(*contents)
                }
                description::SolidTissue::Map { file, .. } => SolidTissue::Map(contents_map(file)?),
            };
            let table = tables.of(optics.tissue.eta);
            Material::Solid(Box::new(SolidMaterial::new(
                tissue,
                optics.tissue,
                table,
                build_coat(optics.coat),
            )))
        }
    })
}

/// A coat with its tables.
pub(super) fn build_coat(coat: description::Coat) -> Coat {
    Coat::new(
        coat.eta as f32,
        coat.alpha_across as f32,
        coat.alpha_along as f32,
    )
}

fn build_light(
    name: &str,
    light: &description::Light,
    meshes: &[TriangleMesh],
    instances: &[Instance],
) -> Result<Light, WorldError> {
    Ok(match light {
        description::Light::Distant {
            towards,
            angular_diameter,
            irradiance,
        } => Light::Distant(DistantLight::new(
            towards.as_vec3(),
            *angular_diameter,
            Curve::from_description(irradiance),
        )),
        description::Light::Constant { radiance } => {
            Light::Constant(Curve::from_description(radiance))
        }
        description::Light::Environment {
            file,
            scale,
            rotation,
            white,
        } => {
            let picture = assets::environment(file).map_err(|source| WorldError::Asset {
                place: format!("lights.{name}"),
                source,
            })?;
            Light::Environment(EnvironmentLight::new(
                picture.texels,
                picture.width,
                Curve::from_description(white).scaled(*scale as f32),
                *rotation as f32,
            ))
        }
        description::Light::Area { object, radiance } => {
            let instance = &instances[*object];
            let mesh = &meshes[instance.mesh as usize];
            let mirrored = instance.to_world.matrix3.determinant() < 0.0;
            let triangles = mesh
                .triangles()
                .iter()
                .map(|face| {
                    let [a, b, c] = face.map(|vertex| {
                        instance
                            .to_world
                            .transform_point3(mesh.positions()[vertex as usize])
                    });
                    if mirrored { [a, c, b] } else { [a, b, c] }
                })
                .collect();
            Light::Area(AreaLight::new(triangles, Curve::from_description(radiance)))
        }
    })
}

/// A rough power in W nm⁻¹, for choosing between lights, in a scene of the given radius (m).
fn power(light: &Light, radius: f32, range_nm: [f64; 2]) -> f32 {
    use std::f32::consts::PI;
    match light {
        Light::Distant(_) | Light::Constant(_) => 0.0,
        Light::Environment(light) => {
            PI * PI * radius * radius * light.mean_brightness() * light.white().mean_over(range_nm)
        }
        Light::Area(light) => PI * light.area() * light.radiance().mean_over(range_nm),
    }
}
