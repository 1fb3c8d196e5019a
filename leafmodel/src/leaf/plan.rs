//! The plan of a leaf: every number that decides it.

use super::damage::Damage;
use super::error::LeafError;
use super::outline_plan::{Contour, OutlinePlan};
use super::venation_plan::VenationPlan;
use crate::blade::BladeForm;
use crate::blade::hairs::HairPlan;
use crate::blade::layers::Layer;
use crate::blade::petiole::PetiolePlan;
use crate::blade::senescence::Senescence;
use crate::blade::stance::Stance;
use crate::blade::surface::SurfacePlan;
use crate::blade::tissue::Tissue;
use crate::blade::unevenness::Unevenness;
use crate::compound::form::CompoundForm;
use crate::document::{Declared, Keys, Limits, Number};
use crate::mosaic::pattern::MosaicPattern;
use crate::optics::contents_keys::contents;
use crate::optics::{Contents, Pigments};
use crate::shape::growth_form::GrowthForm;
use crate::venation::plan::AuxinPlan;

/// Everything that decides a leaf.
#[derive(Clone, Debug, Declared, PartialEq)]
pub struct LeafPlan {
    /// Length of the midrib, mm.
    #[key(with = length)]
    pub length_mm: f64,
    /// Same plan and seed, same leaf, bit for bit.
    #[key("seed")]
    pub seed: u64,
    /// Texels of the content maps along the longer side.
    #[key("map_size", 16..=8192)]
    pub map_size: u32,
    /// The margin.
    #[key(with = margin)]
    pub outline: OutlinePlan,
    /// How its veins come to be.
    #[key("venation", required, block)]
    pub venation: VenationPlan,
    /// What the tissue holds, and how veins change it.
    #[key(with = tissue)]
    pub tissue: Tissue,
    /// What its constituents absorb.
    #[key("pigments", block)]
    pub pigments: Pigments,
    /// Cells of several types, each with contents of its own, in place of the tissue's lamina;
    /// layers come on top.
    #[key(with = cells)]
    pub mosaic: Option<MosaicPattern>,
    /// What lies on the tissue between veins, the later on top.
    #[key(flat, with = Layer::all)]
    pub layers: Vec<Layer>,
    /// How its greens differ from place to place; left out, only by the mottle.
    #[key("unevenness", block)]
    pub unevenness: Option<Unevenness>,
    /// How far it has aged; left out, it is in summer.
    #[key("senescence", block)]
    pub senescence: Option<Senescence>,
    /// What has eaten of it once it had grown.
    #[key("damage", block)]
    pub damage: Option<Damage>,
    /// How the blade lies in space.
    #[key(with = blade)]
    pub form: BladeForm,
    /// What has happened to the blade since.
    pub stance: Stance,
    /// What its faces have below the mesh; left out, they are smooth.
    #[key("surface", block, default = SurfacePlan::SMOOTH)]
    pub surface: Option<SurfacePlan>,
    /// Its hairs, by kind.
    #[key(flat, with = HairPlan::kinds)]
    pub hairs: Vec<HairPlan>,
    #[key(with = one_stalk)]
    /// Its stalk, if it is a simple leaf.
    ///
    /// Leaflets of a compound leaf have those of [`CompoundForm`].
    #[key("petiole", block)]
    pub petiole: Option<PetiolePlan>,
    /// This is the largest leaflet of a compound leaf.
    ///
    /// How its leaflets stand: `Leaf::grow` grows the one leaflet,
    /// [`WholeLeaf::grow`](crate::compound::WholeLeaf::grow) all of them.
    #[key("compound", block, with = CompoundForm::keys)]
    pub compound: Option<CompoundForm>,
}

fn length(plan: &mut LeafPlan, keys: &mut Keys<'_>) {
    let before = plan.length_mm;
    let limits = Number(Limits::closed(0.1, 10_000.0));
    let about = "Length of the midrib.";
    keys.required("length_mm", &mut plan.length_mm, limits, about);
    plan.follow_length(before, plan.length_mm);
}

fn margin(plan: &mut LeafPlan, keys: &mut Keys<'_>) {
    let (kinds, outline) = (Contour::kinds(), &mut plan.outline);
    keys.required_block("outline", "The margin.", &kinds, |keys| {
        outline.declare(keys);
    });
}

fn tissue(plan: &mut LeafPlan, keys: &mut Keys<'_>) {
    let tissue = &mut plan.tissue;
    let before = tissue.lamina;
    let about = "What the lamina holds between veins.";
    let is_partial = keys.reader().is_some_and(|block| block.cx.is_partial.get());
    if !is_partial || keys.has("contents") {
        let lamina = &mut tissue.lamina;
        keys.required_block("contents", about, &[], |keys| contents(lamina, keys));
    }
    // Cells of a preset that held what the tissue does continue to do so.
    let held = plan
        .mosaic
        .iter_mut()
        .flat_map(|mosaic| &mut mosaic.contents);
    for (constituent, own) in held.flat_map(|held| held.iter_mut()) {
        if *own == before[constituent] {
            *own = tissue.lamina[constituent];
        }
    }
    tissue.keys_of_veins(keys);
}

fn cells(plan: &mut LeafPlan, keys: &mut Keys<'_>) {
    let (base, mosaic) = (plan.tissue.lamina, &mut plan.mosaic);
    let about = "Cells of several types.";
    keys.optional_block(
        "mosaic",
        mosaic,
        Default::default,
        about,
        |pattern, keys| {
            pattern.keys(keys, base);
        },
    );
}

fn blade(plan: &mut LeafPlan, keys: &mut Keys<'_>) {
    let length_mm = plan.length_mm;
    keys.block("blade", "How the blade lies in space.", |keys| {
        // A finer mesh than this has more than some ten million triangles.
        let edges = Limits::closed((length_mm / 2000.0).max(0.001), length_mm);
        plan.form.keys(keys, edges);
        plan.stance.declare(keys);
    });
}

/// Leaflets have stalks of their own.
fn one_stalk(_: &mut LeafPlan, keys: &mut Keys<'_>) {
    keys.exclude("compound", "petiole");
}

impl LeafPlan {
    /// A leaf of which nothing is said but its length.
    pub fn of_length(length_mm: f64) -> Self {
        Self {
            length_mm,
            seed: 0,
            map_size: 1024,
            outline: Contour::GrowthAlgorithm(GrowthForm::default()).into(),
            venation: AuxinPlan::default().into(),
            tissue: Tissue::of(Contents::NOTHING),
            pigments: Pigments::default(),
            mosaic: None,
            layers: Vec::new(),
            unevenness: None,
            senescence: None,
            damage: None,
            form: BladeForm::nearly_flat(length_mm),
            stance: Stance::default(),
            surface: None,
            hairs: Vec::new(),
            petiole: None,
            compound: None,
        }
    }

    /// Lets what has the default for one length of the leaf have that for another.
    pub(crate) fn follow_length(&mut self, before: f64, after: f64) {
        if self.form.max_edge_mm == BladeForm::nearly_flat(before).max_edge_mm {
            self.form.max_edge_mm = BladeForm::nearly_flat(after).max_edge_mm;
        }
    }

    /// The plan of the same leaf in space, whose contents and faces cost no time: they are those of
    /// plain tissue on the smallest map.
    ///
    /// # Errors
    ///
    /// [`LeafError`] for a number out of range in what is left out.
    pub fn form_alone(&self) -> Result<Self, LeafError> {
        self.validate_tissue()?;
        Ok(Self {
            layers: Vec::new(),
            mosaic: None,
            senescence: None,
            // The bulge displaces the mesh.
            surface: self.surface.as_ref().map(SurfacePlan::displacement_alone),
            unevenness: None,
            map_size: 16,
            ..self.clone()
        })
    }

    /// Checks the numbers of contents and faces.
    pub(super) fn validate_tissue(&self) -> Result<(), LeafError> {
        self.tissue.validate()?;
        if let Some(unevenness) = &self.unevenness {
            unevenness.in_range()?;
        }
        self.layers.iter().try_for_each(Layer::validate)?;
        if let Some(mosaic) = &self.mosaic {
            mosaic.validate().map_err(LeafError::Mosaic)?;
        }
        if let Some(surface) = &self.surface {
            surface.validate()?;
        }
        self.check_senescence()
    }

    /// Whether the leaf can age as it should, as far as can be told without growing it.
    ///
    /// # Errors
    ///
    /// [`LeafError::Tissue`], [`LeafError::NoRevenue`].
    pub fn check_senescence(&self) -> Result<(), LeafError> {
        let Some(senescence) = &self.senescence else {
            return Ok(());
        };
        senescence.in_range()?;
        if !senescence.needs_cells() {
            return Ok(());
        }
        self.has_cells().then_some(()).ok_or(LeafError::NoRevenue)
    }

    /// Whether it has the cells of a transport leaf, which earn revenue.
    pub(crate) fn has_cells(&self) -> bool {
        matches!(self.venation, VenationPlan::Transport(_))
            || matches!(self.outline.contour, Contour::Transport(_))
    }
}
