//! The switch of the changes, put into a crate as its module `mx`: `MUTANT=7` turns the seventh on, `MUTANT_TRACE=FILE`
//! notes which ones a test reaches. It stands in copies alone.
use std::io::Write;
use std::sync::LazyLock;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering::Relaxed};

const ASK: u32 = u32::MAX;
const TRACE: u32 = u32::MAX - 1;
static ACTIVE: AtomicU32 = AtomicU32::new(ASK);
static SEEN: [AtomicBool; 8192] = [const { AtomicBool::new(false) }; 8192];
static FILE: LazyLock<std::fs::File> = LazyLock::new(|| {
    std::fs::OpenOptions::new()
        .create(true)
        .append(true)
        .open(std::env::var("MUTANT_TRACE").unwrap())
        .unwrap()
});

#[inline]
pub fn on(id: u32) -> bool {
    let active = ACTIVE.load(Relaxed);
    active == id || (active >= TRACE && asked(id))
}

#[cold]
#[inline(never)]
fn asked(id: u32) -> bool {
    if ACTIVE.load(Relaxed) == ASK {
        let active = if std::env::var("MUTANT_TRACE").is_ok() {
            TRACE
        } else {
            std::env::var("MUTANT").ok().and_then(|id| id.parse().ok()).unwrap_or(0)
        };
        ACTIVE.store(active, Relaxed);
    }
    if ACTIVE.load(Relaxed) == TRACE && !SEEN[id as usize].swap(true, Relaxed) {
        let _ = (&*FILE).write_all(format!("{id}\n").as_bytes());
    }
    ACTIVE.load(Relaxed) == id
}
