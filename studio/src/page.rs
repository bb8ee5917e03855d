//! The page: its sources, put together. What reports and the studio both draw with is theirs in common.

use gambol_reports::page::{
    CHART_SCRIPT, CLOCK_SCRIPT, DATA_SCRIPT, DRAWING_SCRIPT, NETWORK_SCRIPT, STAGE_SCRIPT, STYLE, TERRAIN_SCRIPT,
    script,
};

/// The page, which refers to *studio.css* and *studio.js* beside it.
pub const PAGE: &str = include_str!("../assets/studio.html");

const CONNECTION: &str = include_str!("../assets/connection.js");

const STYLES: &[&str] = &[
    STYLE,
    include_str!("../assets/studio.css"),
    include_str!("../assets/editor.css"),
    include_str!("../assets/terrain_editor.css"),
];

const SCRIPTS: &[&str] = &[
    DATA_SCRIPT,
    CLOCK_SCRIPT,
    TERRAIN_SCRIPT,
    STAGE_SCRIPT,
    DRAWING_SCRIPT,
    CHART_SCRIPT,
    NETWORK_SCRIPT,
    CONNECTION,
    include_str!("../assets/crowd.js"),
    include_str!("../assets/arena.js"),
    include_str!("../assets/net.js"),
    include_str!("../assets/members.js"),
    include_str!("../assets/beside.js"),
    include_str!("../assets/watch.js"),
    include_str!("../assets/settings.js"),
    include_str!("../assets/portrait.js"),
    include_str!("../assets/choose.js"),
    include_str!("../assets/play.js"),
    include_str!("../assets/link.js"),
    include_str!("../assets/remembered.js"),
    include_str!("../assets/keep.js"),
    include_str!("../assets/editor_geometry.js"),
    include_str!("../assets/editor_decorations.js"),
    include_str!("../assets/editor_limbs.js"),
    include_str!("../assets/editor_fields.js"),
    include_str!("../assets/editor_panel.js"),
    include_str!("../assets/editor_decoration_list.js"),
    include_str!("../assets/editor_history.js"),
    include_str!("../assets/editor.js"),
    include_str!("../assets/editor_hand.js"),
    include_str!("../assets/editor_canvas.js"),
    include_str!("../assets/terrain_geometry.js"),
    include_str!("../assets/terrain_panel.js"),
    include_str!("../assets/terrain_editor.js"),
    include_str!("../assets/terrain_hand.js"),
    include_str!("../assets/terrain_canvas.js"),
    include_str!("../assets/studio.js"),
];

/// All styles as one.
pub fn styles() -> String {
    STYLES.join("\n")
}

/// All scripts as one, with that of a home of the studio: it has a function `connect`, which gives a `Connection`.
pub fn scripts(home: &str) -> String {
    let parts: Vec<&str> =
        SCRIPTS.iter().flat_map(|&part| if part == CONNECTION { vec![part, home] } else { vec![part] }).collect();
    script(&parts)
}

/// The home of a studio that is served.
pub const SERVED: &str = include_str!("../assets/socket.js");
