//! A thousand chains at a time: how the horizontal pull grows as the anchors are drawn apart.

use funicular::prelude::*;

/// Ten bars of 0.1 m and 0.2 kg between level anchors.
fn chain(span_m: f64) -> Result<Problem, Error> {
    let anchors = Anchors { start_m: [0.0; 3], end_m: [span_m, 0.0, 0.0] };
    Chain::new("ten bars", 9.80665, anchors, vec![Bar::homogeneous(0.1, 0.2)?; 10])?.try_into()
}

fn main() -> Result<(), Error> {
    let spans_m: Vec<f64> = (0..1000).map(|k| 0.2 + 0.79 * f64::from(k) / 999.0).collect();
    let problems = spans_m.iter().map(|&span_m| chain(span_m)).collect::<Result<Vec<_>, _>>()?;
    let answers = Solve::new().census(UseCensus::Never).run_all(&problems)?;

    let mut agreed = 0;
    println!("span_m,pull_n,sag_m");
    for (span_m, answer) in spans_m.iter().zip(answers) {
        let answer = answer?;
        agreed += usize::from(answer.agrees());
        let hanging = &answer.equilibria()[0];
        let sag_m = -hanging.joints_m.iter().map(|joint| joint[2]).fold(0.0, f64::min);
        println!("{span_m},{},{sag_m}", -hanging.reactions_n[0][0]);
    }
    eprintln!("{agreed} of {} agree", problems.len());
    Ok(())
}
