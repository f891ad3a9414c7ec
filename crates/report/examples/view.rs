//! The interactive view in a page of its own:
//! `cargo run -p report --example view > view.html`

use report::view::View;

/// Random seeds of each kind: the view does not show what they lead to.
const SEEDS: usize = 10;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let reproduction = paper::reproduction::reproduce_with(SEEDS, |next| eprintln!("{next}"))?;
    let view = View::new(&reproduction).fragment()?;
    println!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>The chain of three bars</title>\n\
         <style>:root {{ color-scheme: light dark; }}\n\
         body {{ margin: 0 auto; padding: 1rem; max-width: 60rem; font: 1rem/1.5 system-ui, sans-serif;\n\
         background: #fff; color: #1b1f24; }}\n\
         @media (prefers-color-scheme: dark) {{ body {{ background: #14171b; color: #e4e8ec; }} }}</style>\n\
         </head>\n<body>\n<main>\n<h1>The chain of three bars</h1>\n{view}</main>\n</body>\n</html>"
    );
    Ok(())
}
