//! A description in words.

use super::Description;
use crate::venation::architecture::{PrimaryPattern, SecondaryEnding, SecondarySpacing};

impl Description {
    /// Lines of text, one for each group of veins.
    pub fn text(&self) -> String {
        let lines = [
            self.primaries_text(),
            self.secondaries_text(),
            self.tertiaries_text(),
            self.net_text(),
            self.margin_text(),
        ];
        lines
            .into_iter()
            .flatten()
            .map(|line| line + "\n")
            .collect()
    }

    fn primaries_text(&self) -> Option<String> {
        let pattern = match self.primaries? {
            PrimaryPattern::Pinnate => "pinnate".to_owned(),
            kind @ (PrimaryPattern::Actinodromous
            | PrimaryPattern::Palinactinodromous
            | PrimaryPattern::Acrodromous
            | PrimaryPattern::Parallelodromous
            | PrimaryPattern::Campylodromous
            | PrimaryPattern::Flabellate) => {
                let place = match self.part_at {
                    Some(at) if at > 0.02 => "suprabasal",
                    Some(_) | None => "basal",
                };
                let count = self.lateral_primaries + 1;
                format!("{place} {}, {count} primaries", name(kind))
            }
        };
        let course = match self.midrib_over_chord {
            Some(ratio) if ratio <= 1.02 => "straight",
            Some(_) | None => "winding",
        };
        Some(format!("primary veins: {pattern}; midrib {course}"))
    }

    fn secondaries_text(&self) -> Option<String> {
        let ending = match self.ending? {
            SecondaryEnding::Craspedodromous => "craspedodromous",
            SecondaryEnding::Semicraspedodromous => "semicraspedodromous",
            SecondaryEnding::Eucamptodromous => "eucamptodromous",
            SecondaryEnding::Brochidodromous => "brochidodromous",
            SecondaryEnding::Festooned => "festooned brochidodromous",
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
        let spacing = match self.spacing {
            Some(SecondarySpacing::Regular) => ", spacing regular",
            Some(SecondarySpacing::IncreasingProximally) => ", spacing increasing proximally",
            Some(SecondarySpacing::DecreasingProximally) => ", spacing decreasing proximally",
            None => "",
        };
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
        Some(format!(
            "secondary veins: {ending}, {pairs}{course}{spacing}; angle {angles}{between}"
        ))
    }

    fn tertiaries_text(&self) -> Option<String> {
        let share = self.percurrent?;
        if share <= 0.5 {
            return Some("tertiary veins: reticulate".to_owned());
        }
        let course = match self.tertiary_over_chord {
            Some(winding) if winding < 1.04 => "straight",
            Some(_) | None => "sinuous or offset",
        };
        let angle = self
            .tertiary_angle_deg
            .map(|angle| format!(", {angle:.0}° to the secondary"))
            .unwrap_or_default();
        Some(format!("tertiary veins: percurrent, {course}{angle}"))
    }

    fn net_text(&self) -> Option<String> {
        let elongation = self.areole_elongation?;
        let veinlets = self.veinlets_per_areole?;
        let number = match veinlets {
            few if few < 0.1 => "without freely ending veinlets".to_owned(),
            some => format!("{some:.1} freely ending veinlets each"),
        };
        Some(format!(
            "areoles: {:.1} per mm², median elongation {elongation:.2}, {number}",
            self.areoles_per_mm2
        ))
    }

    fn margin_text(&self) -> Option<String> {
        let share = self.free_at_margin?;
        let words = if share < 0.25 {
            "looped"
        } else {
            "incomplete: veins end freely at the margin"
        };
        Some(format!("marginal ultimate venation: {words}"))
    }
}

fn name(pattern: PrimaryPattern) -> &'static str {
    match pattern {
        PrimaryPattern::Pinnate => "pinnate",
        PrimaryPattern::Actinodromous => "actinodromous",
        PrimaryPattern::Palinactinodromous => "palinactinodromous",
        PrimaryPattern::Acrodromous => "acrodromous",
        PrimaryPattern::Parallelodromous => "parallelodromous",
        PrimaryPattern::Campylodromous => "campylodromous",
        PrimaryPattern::Flabellate => "flabellate",
    }
}
