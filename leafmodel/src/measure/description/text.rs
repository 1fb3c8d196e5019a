//! A description in words.

use super::{Areolation, Description, MarginalVenation, Veinlets};
use crate::document::Words;
use crate::venation::architecture::{Agrophic, PrimaryPattern};

impl Description {
    /// Lines of text, one for each group of veins.
    pub fn text(&self) -> String {
        let lines = [
            self.primaries_text(),
            self.secondaries_text(),
            self.agrophic_text(),
            self.tertiaries_text(),
            self.quaternaries_text(),
            self.areoles_text(),
            self.veinlets_text(),
            self.margin_text(),
        ];
        lines
            .into_iter()
            .flatten()
            .map(|line| line + "\n")
            .collect()
    }

    fn primaries_text(&self) -> Option<String> {
        let pattern = self.primaries?;
        let words = if pattern == PrimaryPattern::Pinnate {
            pattern.word().to_owned()
        } else {
            let place = match self.part_at {
                Some(at) if at > 0.02 => "suprabasal",
                Some(_) | None => "basal",
            };
            let count = self.lateral_primaries + 1;
            format!("{place} {}, {count} primaries", pattern.word())
        };
        let course = match self.midrib_over_chord {
            Some(ratio) if ratio <= 1.02 => "straight",
            Some(_) | None => "winding",
        };
        Some(format!("primary veins: {words}; midrib {course}"))
    }

    fn secondaries_text(&self) -> Option<String> {
        let ending = match self.ending?.word() {
            "sinus" => "ending in sinuses",
            "festooned" => "festooned brochidodromous",
            word => word,
        };
        let [right, left] = self.secondaries;
        let pairs = if right == left {
            format!("{right} pairs")
        } else {
            format!("{} to {} pairs", right.min(left), right.max(left))
        };
        let course = match self.are_straight {
            Some(true) => ", straight",
            Some(false) => ", curved",
            None => "",
        };
        let spacing = after_comma("spacing ", self.spacing);
        let thirds = ["below", "in the middle", "above"];
        let angles: Vec<String> = thirds
            .iter()
            .zip(self.angles_deg)
            .filter_map(|(third, angle)| Some(format!("{:.0}° {third}", angle?)))
            .collect();
        let between = match self.intersecondaries {
            Some(count) if count >= 0.05 => format!("; {count:.1} intersecondaries to a space"),
            Some(_) | None => String::new(),
        };
        let angles = angles.join(", ");
        let attachment = after_comma("", self.attachment);
        Some(format!(
            "secondary veins: {ending}, {pairs}{attachment}{course}{spacing}; angle {angles}{between}"
        ))
    }

    fn agrophic_text(&self) -> Option<String> {
        self.primaries?;
        let words = words(&self.agrophic);
        (self.agrophic != Agrophic::Absent).then(|| format!("agrophic veins: {words}"))
    }

    fn tertiaries_text(&self) -> Option<String> {
        let found = &self.tertiaries;
        if !found.is_percurrent()? {
            return Some("tertiary veins: reticulate".to_owned());
        }
        let course = match found.length_over_chord {
            _ if found.are_chevrons() => "forming chevrons",
            Some(winding) if winding < 1.04 => "straight",
            Some(_) | None => "sinuous or offset",
        };
        let angle = found
            .angle_deg
            .map(|angle| format!(", {angle:.0}° to the secondary"))
            .unwrap_or_default();
        Some(format!("tertiary veins: percurrent, {course}{angle}"))
    }

    fn quaternaries_text(&self) -> Option<String> {
        let words = words(&self.quaternaries.quaternary_course()?);
        Some(format!("quaternary veins: {words}"))
    }

    fn areoles_text(&self) -> Option<String> {
        let net = &self.net;
        let (sides, elongation) = (net.sides?, net.elongation?);
        let words = match net.areolation() {
            Areolation::Lacking => return Some("areolation: lacking".to_owned()),
            Areolation::Poor => "poorly developed",
            Areolation::Moderate => "moderately developed",
            Areolation::Good => "well developed",
        };
        Some(format!(
            "areolation: {words}, {:.1} per mm², {sides:.0} sides, median elongation {elongation:.2}",
            net.areoles_per_mm2
        ))
    }

    fn veinlets_text(&self) -> Option<String> {
        let net = &self.net;
        let number = net.veinlets_per_areole?;
        let words = match net.veinlets() {
            Veinlets::Absent => return Some("freely ending veinlets: absent".to_owned()),
            Veinlets::Unbranched => "mostly unbranched",
            Veinlets::BranchedOnce => "mostly branched once",
            Veinlets::Dendritic => "mostly dendritic",
        };
        let ends = net.free_ends_per_areole?;
        Some(format!(
            "freely ending veinlets: {words}, {number:.1} to an areole with {ends:.1} free ends"
        ))
    }

    fn margin_text(&self) -> Option<String> {
        let words = match self.marginal? {
            MarginalVenation::Fimbrial => "a fimbrial vein",
            MarginalVenation::Looped => "looped",
            MarginalVenation::Incomplete => "incomplete: veins end freely at the margin",
        };
        Some(format!("marginal ultimate venation: {words}"))
    }
}

/// The word for one of several, as it is read.
fn words(of: &(impl Words + PartialEq)) -> String {
    of.word().replace('_', " ")
}

/// The same behind a comma and a noun.
fn after_comma(noun: &str, of: Option<impl Words + PartialEq>) -> String {
    of.map_or_else(String::new, |of| format!(", {noun}{}", words(&of)))
}
