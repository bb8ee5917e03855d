//! The champion's gait for the page.

use base64::{Engine, engine::general_purpose::STANDARD};
use gambol_runs::{judge::Gait, obstacles::ObstaclesPassed};
use serde::Serialize;
use tasks::gait::GaitReport;

/// A gait report with what only Rust can say of it.
#[derive(Serialize)]
pub(super) struct GaitData {
    #[serde(flatten)]
    report: GaitReport,
    /// What it did on its terrain, in words: "gaps crossed" and "7 of 20".
    obstacles: Vec<[String; 2]>,
    /// What speaks against it, in words.
    against: Vec<String>,
    /// What the audit flagged, in words.
    flagged: Vec<String>,
    /// The contact sheet, as the address of an image.
    sheet: String,
}

impl GaitData {
    /// `sheet`: its contact sheet, a PNG image.
    pub(super) fn new(Gait { report, obstacles }: Gait, sheet: &[u8]) -> Self {
        let told = |ObstaclesPassed { kind, passed, of }: &ObstaclesPassed| {
            [kind.passed().to_owned(), format!("{passed} of {of}")]
        };
        let reasons = report.verdict.iter().flat_map(|verdict| &verdict.reasons);
        Self {
            obstacles: obstacles.iter().map(told).collect(),
            against: reasons.map(ToString::to_string).collect(),
            flagged: report.cheats.iter().map(ToString::to_string).collect(),
            sheet: format!("data:image/png;base64,{}", STANDARD.encode(sheet)),
            report,
        }
    }
}
