//! What the command line says.

use std::path::PathBuf;

use crate::Failure;

pub const USAGE: &str = "usage: mutants CRATE[,CRATE] [--from LIST] [--draw N] [--seed S] [--only FILE] [--also CRATE]
               [--skip WORD] [--work DIR] [--target-dir DIR] [--limit SECONDS]
               [--also-limit SECONDS] [--jobs N] [--out FILE]
Run at the top of the workspace. The changes of several crates are built together, and what survives to the tests of its
own crate is shown to those of the others, too.
  --from LIST       cargo: those of `cargo mutants` (else); plausible: those that people make by mistake
  --draw N          changes of each crate drawn at random, the first ones that compile; without it all
  --seed S          of the draw
  --only FILE       the changes of one crate named in the tables of a result, by file, text and nearest line
  --also CRATE      shows what survives to the tests of another crate, too; may be given again
  --skip WORD       tests of other crates with this in their names are not asked; may be given again
  --work DIR        where the copy of the workspace goes (target/mutants)
  --target-dir DIR  of its builds (target of that folder): a copy of a warm one saves the third-party crates.
                    Its own alone: cargo takes the crates of another tree there for those of this one
  --limit SECONDS   tests that take longer are not asked (30)
  --also-limit SECONDS  the same of tests of other crates than that of the change (the lower of both)
  --jobs N          tests at a time (2)
  --out FILE        of the result, Markdown";

pub struct Options {
    pub krates: Vec<String>,
    pub also: Vec<String>,
    pub skip: Vec<String>,
    pub plausible: bool,
    pub draw: usize,
    pub seed: u64,
    pub only: Option<PathBuf>,
    pub work: PathBuf,
    pub target: PathBuf,
    pub limit: f64,
    pub also_limit: f64,
    pub jobs: usize,
    pub out: Option<PathBuf>,
}

impl Options {
    /// # Errors
    ///
    /// The usage, where an argument is unknown, lacks its value or is no number.
    pub fn from_args(mut args: impl Iterator<Item = String>) -> Result<Self, Failure> {
        let krate = args.next().filter(|name| !name.starts_with('-')).ok_or(USAGE)?;
        let mut options = Self {
            krates: krate.split(',').map(str::to_owned).collect(),
            also: Vec::new(),
            skip: Vec::new(),
            plausible: false,
            draw: usize::MAX / 2,
            seed: 1,
            only: None,
            work: PathBuf::from("target/mutants"),
            target: PathBuf::new(),
            limit: 30.0,
            also_limit: f64::INFINITY,
            jobs: 2,
            out: None,
        };
        while let Some(name) = args.next() {
            let value = args.next().ok_or(USAGE)?;
            match name.as_str() {
                "--from" if value == "cargo" || value == "plausible" => {
                    options.plausible = value == "plausible";
                }
                "--draw" => options.draw = value.parse()?,
                "--seed" => options.seed = value.parse()?,
                "--only" => options.only = Some(value.into()),
                "--also" => options.also.push(value),
                "--skip" => options.skip.push(value),
                "--work" => options.work = value.into(),
                "--target-dir" => options.target = value.into(),
                "--limit" => options.limit = value.parse()?,
                "--also-limit" => options.also_limit = value.parse()?,
                "--jobs" => options.jobs = value.parse()?,
                "--out" => options.out = Some(value.into()),
                _ => return Err(USAGE.into()),
            }
        }
        if options.only.is_some() && options.krates.len() > 1 {
            // Files of the same name are not told apart.
            return Err(USAGE.into());
        }
        options.also_limit = options.also_limit.min(options.limit);
        options.work = std::path::absolute(&options.work)?;
        if options.target.as_os_str().is_empty() {
            options.target = options.work.join("target");
        }
        options.target = std::path::absolute(&options.target)?;
        Ok(options)
    }

    /// The packages whose tests are asked, those with changes first.
    pub fn packages(&self) -> impl Iterator<Item = &str> {
        self.krates.iter().chain(&self.also).map(String::as_str)
    }
}
