//! What charts are drawn of, for whoever draws their own.

use omni_gap::report::Pictures;
use serde_json::{Value, json};

/// The panels as JSON: title, unit, what they are over, and the series, each with its name, in their order.
pub fn as_json(pictures: &Pictures) -> String {
    let panel = |panel: &omni_gap::report::Panel| {
        let series: Vec<Value> = panel.series.iter().map(|series| json!([series.name, series.values])).collect();
        json!({ "title": panel.title, "unit": panel.unit, "t_s": panel.t_s, "series": series })
    };
    let panels: Vec<Value> = pictures.panels.iter().map(panel).collect();
    json!({ "caption": pictures.caption, "restarts_s": pictures.restarts_s, "panels": panels }).to_string()
}
