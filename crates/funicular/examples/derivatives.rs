//! How stiff two bars hold their anchor, and which number the depth of their joint depends on most.

use funicular::prelude::*;

fn main() -> Result<(), Error> {
    // Two bars without mass of 5 m over a span of 6 m, with 8 N in the middle: 4 m deep.
    let problem = Problem::parse(
        "gravity_m_s2 = 10\n\
         joints = { A = { at_m = [-3, 0, 0] }, B = { at_m = [3, 0, 0] }, P = { mass_kg = 0.8 } }\n\
         bars = [{ from = \"A\", to = \"P\", length_m = 5, mass_kg = 0 },\n\
                 { from = \"P\", to = \"B\", length_m = 5, mass_kg = 0 }]",
        "two.toml",
    )?;
    let derivatives = Derivatives::new().run(&problem)?;
    for pair in derivatives.anchor_stiffness()? {
        let along = pair.stiffness_n_m[0][0];
        println!("force at {} by place of {}, along x: {along:.6} N/m", pair.of, pair.by);
    }
    let depth = derivatives.gradient("joints.P.at_m.z")?;
    for name in ["bars.1.length_m", "joints.B.at_m.x", "joints.P.mass_kg"] {
        if let Some(by) = depth.by(name) {
            println!("height of P by {name}: {:.6}", by.value);
        }
    }
    Ok(())
}
