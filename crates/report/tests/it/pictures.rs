//! Pictures whose paths are counted.

use crate::REPORT;

/// Starts beside one another that lead to one place are one box.
#[test]
fn neighbours_make_one_run() {
    let mut reproduction = REPORT.reproduction().clone();
    reproduction.figures.basins[0].rows = vec!["1121-1".to_owned(); 6];
    let panel = &report::figures::basins(&reproduction).panels[0];
    let boxes = |class: &str| {
        let (_, path) = panel.split_once(&format!("class=\"basin {class}\"")).unwrap_or_default();
        path.split("/>").next().unwrap().matches('M').count()
    };
    assert_eq!(["first", "second", "none", "fourth"].map(boxes), [3 * 6, 6, 6, 0]);
}
