//! Margin and veins in every format that shows them, with or without a caption.

use glam::DVec2;
use leafmodel::export::{self, SvgStyle};
use leafmodel::shape::outline::Outline;
use leafmodel::venation::network::VenationNetwork;

use crate::cli::arguments::{CaptionedKinds, GrowArguments, VeinColour};
use crate::cli::terminal::Failure;
use crate::export::caption::{Note, captioned};
use crate::export::drawing::{
    Drawing, SOURCE_COLOUR, Style, Subject, age_colour, draw_within, pixels_per_mm,
};
use crate::export::veins::VeinFormat;

/// Lower left and upper right corner of what a picture shows, mm.
pub(super) type Page = (DVec2, DVec2);

/// Number of colours in the key of ages.
const SHADES: usize = 24;

/// The look of all pictures of a leaf.
#[derive(Clone, Copy, Debug)]
pub(super) struct Look {
    /// What they show; stages of a leaf share the page of the full-grown one.
    pub(super) page: Page,
    /// Pixels along the longer side of the drawing.
    pub(super) pixels: u32,
    /// What colours of veins tell.
    pub(super) colour: VeinColour,
    /// Kinds of pictures that have a caption.
    pub(super) captions: CaptionedKinds,
    /// Whether sources are drawn.
    pub(super) sources: bool,
    /// The last step of growth.
    pub(super) last_step: u32,
    /// The greatest order of the full-grown leaf's veins.
    pub(super) last_order: u8,
}

impl Look {
    /// The look that is asked for, of pictures of a leaf with these veins.
    pub(super) fn asked_for(
        arguments: &GrowArguments,
        page: Page,
        network: &VenationNetwork,
    ) -> Self {
        let orders = network.edges().iter().map(|edge| edge.order);
        Self {
            page,
            pixels: arguments.size,
            colour: arguments.colour,
            captions: arguments.caption,
            sources: arguments.sources,
            last_step: network.steps(),
            last_order: orders.max().unwrap_or(1),
        }
    }

    /// A leaf, or a stage of it after `step`, in a format that shows its veins.
    pub(super) fn file(
        &self,
        format: VeinFormat,
        subject: Subject,
        step: Option<u32>,
    ) -> Result<Vec<u8>, Failure> {
        let svg = SvgStyle {
            orders_in_colour: self.colour == VeinColour::Order,
            ..SvgStyle::default()
        };
        match format.text(self.page, subject.outlines, subject.network, svg) {
            Some(text) => Ok(text.into_bytes()),
            None => self
                .drawn(false, subject, step)?
                .png()
                .map_err(Failure::bad),
        }
    }

    /// The picture for a PNG or a film.
    pub(super) fn drawn(
        &self,
        is_film: bool,
        subject: Subject,
        step: Option<u32>,
    ) -> Result<Drawing, Failure> {
        let style = match self.colour {
            VeinColour::Plain => Style::OnPaper,
            VeinColour::Order => Style::Orders,
            VeinColour::Age => Style::Ages {
                last: self.last_step,
            },
        };
        let subject = Subject {
            sources: if self.sources { subject.sources } else { &[] },
            ..subject
        };
        let drawing = draw_within(self.page, subject, self.pixels, style).map_err(Failure::bad)?;
        if !has_caption(self.captions, is_film) {
            return Ok(drawing);
        }
        Ok(captioned(&drawing, &self.notes(step)))
    }

    fn notes(&self, step: Option<u32>) -> Vec<Note> {
        let mut notes = vec![Note::ScaleBar {
            pixels_per_mm: pixels_per_mm(self.page, self.pixels),
        }];
        let mut swatches = Vec::new();
        match self.colour {
            VeinColour::Plain => {}
            VeinColour::Order => {
                let most = export::ORDER_COLOURS.len() as u8;
                let shown = self.last_order.clamp(1, most);
                swatches.extend((1..=shown).map(|order| {
                    let and_more = if self.last_order > most && order == most {
                        "+"
                    } else {
                        ""
                    };
                    (export::order_colour(order), format!("{order}{and_more}"))
                }));
            }
            VeinColour::Age => {
                let share = |i: usize| i as f64 / (SHADES - 1) as f64;
                notes.push(Note::Ramp {
                    colours: (0..SHADES).map(|i| age_colour(share(i))).collect(),
                    ends: ["step 0".to_owned(), self.last_step.to_string()],
                });
            }
        }
        if self.sources {
            swatches.push((SOURCE_COLOUR, "sources".to_owned()));
        }
        if !swatches.is_empty() {
            notes.push(Note::Swatches(swatches));
        }
        notes.extend(step.map(|step| {
            let digits = self.last_step.to_string().len();
            Note::Text(format!("step {step:>digits$} of {}", self.last_step))
        }));
        notes
    }
}

/// Whether pictures of this kind have a caption.
pub(super) fn has_caption(captions: CaptionedKinds, is_film: bool) -> bool {
    match captions {
        CaptionedKinds::All => true,
        CaptionedKinds::Films => is_film,
        CaptionedKinds::None => false,
    }
}

/// What is drawn of a leaf without sources.
pub(super) fn without_sources<'a>(
    outlines: &'a [Outline],
    network: &'a VenationNetwork,
) -> Subject<'a> {
    Subject {
        outlines,
        network,
        sources: &[],
    }
}
