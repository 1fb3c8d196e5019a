//! The examples of Xia 2007, and a maple with transport veins.

use super::super::{PlanOf, Preset, xia};

pub(super) static TRANSPORT: &[Preset] = &[
    Preset {
        name: "xia-1",
        about: "Example 1, Fig. 1: a leaf that grows as the cheapest transport network, and its veins",
        source: "Xia 2007, Example 1, all parameters; steps of growth, length and vein width are ours",
        row: None,
        plan: PlanOf::Function(xia::example_1),
    },
    Preset {
        name: "xia-2",
        about: "Example 2, Fig. 2: dearer turns, a larger and longer leaf",
        source: "Xia 2007, Example 2, all parameters; steps of growth, length and vein width are ours",
        row: None,
        plan: PlanOf::Function(xia::example_2),
    },
    Preset {
        name: "xia-3",
        about: "Example 3, Fig. 3: maple-like, five large lobes and two small ones",
        source: "after Xia 2007, which prints no parameters: searched for by lobes; sinuses are shallower than in the figure",
        row: None,
        plan: PlanOf::Function(xia::example_3),
    },
    Preset {
        name: "xia-4",
        about: "Example 4, Fig. 4: cordate, mulberry-like, five pairs of secondary veins",
        source: "after Xia 2007, which prints no parameters: searched for by the measures of Figs. 4 and 6",
        row: None,
        plan: PlanOf::Function(xia::example_4),
    },
    Preset {
        name: "xia-5",
        about: "Example 5, Fig. 5: a member of the sweep over α, at 0.65",
        source: "after Xia 2007, which prints neither α nor β of the sweep: β and ε of Example 1",
        row: None,
        plan: PlanOf::Function(|| xia::example_5(0.65, 269.0)),
    },
    Preset {
        name: "xia-5a",
        about: "Example 5, Fig. 5: the sweep over α, at 0.5",
        source: "after Xia 2007, which prints neither α nor β of the sweep: β and ε of Example 1",
        row: None,
        plan: PlanOf::Function(|| xia::example_5(0.5, 11027.0)),
    },
    Preset {
        name: "xia-5b",
        about: "Example 5, Fig. 5: the sweep over α, at 0.55",
        source: "after Xia 2007, which prints neither α nor β of the sweep: β and ε of Example 1",
        row: None,
        plan: PlanOf::Function(|| xia::example_5(0.55, 1946.0)),
    },
    Preset {
        name: "xia-5c",
        about: "Example 5, Fig. 5: the sweep over α, at 0.6, which is Example 1",
        source: "after Xia 2007, which prints neither α nor β of the sweep: β and ε of Example 1",
        row: None,
        plan: PlanOf::Function(|| xia::example_5(0.6, 554.0)),
    },
    Preset {
        name: "xia-5d",
        about: "Example 5, Fig. 5: the sweep over α, at 0.65, the same as xia-5",
        source: "after Xia 2007, which prints neither α nor β of the sweep: β and ε of Example 1",
        row: None,
        plan: PlanOf::Function(|| xia::example_5(0.65, 269.0)),
    },
    Preset {
        name: "xia-5e",
        about: "Example 5, Fig. 5: the sweep over α, at 0.7",
        source: "after Xia 2007, which prints neither α nor β of the sweep: β and ε of Example 1",
        row: None,
        plan: PlanOf::Function(|| xia::example_5(0.7, 128.0)),
    },
    Preset {
        name: "xia-5f",
        about: "Example 5, Fig. 5: the sweep over α, at 0.725",
        source: "after Xia 2007, which prints neither α nor β of the sweep: β and ε of Example 1",
        row: None,
        plan: PlanOf::Function(|| xia::example_5(0.725, 118.0)),
    },
    Preset {
        name: "xia-autumn",
        about: "Example 1 in autumn: cells that no longer pay for their supply have died, from the tips",
        source: "Xia 2007, Example 1 and Remark 3.6, which has no figure; how far autumn has come and what dead tissue holds are ours",
        row: None,
        plan: PlanOf::Function(xia::autumn),
    },
    Preset {
        name: "maple-transport",
        about: "The maple with the veins that supply its cells most cheaply; they run along the grid of cells",
        source: "ours: the transport cost of Xia 2007 with α and β of Example 1 on a given outline; the rest as in maple",
        row: None,
        plan: PlanOf::Function(xia::maple),
    },
];
