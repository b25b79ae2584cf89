//! Prints the public API that a file of rustdoc's JSON describes, a line an item.
//!
//! Left out is what follows from the rest: blanket and auto trait implementations, and what stands in
//! an implementation of a trait, except associated types, since the trait says it.

use std::collections::{HashMap, HashSet};
use std::error::Error;

use public_api::{Builder, PublicItem};

fn main() -> Result<(), Box<dyn Error>> {
    let json = std::env::args_os().nth(1).ok_or("usage: print-api JSON")?;
    let api = Builder::from_rustdoc_json(json)
        .omit_blanket_impls(true)
        .omit_auto_trait_impls(true)
        .build()?;
    let items: HashMap<_, _> = api.items().map(|item| (item.id(), item)).collect();
    let follows = |item: &PublicItem| {
        let parent = item.parent_id().and_then(|id| items.get(&id));
        parent.is_some_and(|parent| is_of_a_trait(parent))
            && !item.to_string().starts_with("pub type ")
    };
    // An implementation stands both with its type and with its trait.
    let mut printed = HashSet::new();
    for line in api.items().filter(|item| !follows(item)).map(ToString::to_string) {
        if !printed.contains(&line) {
            println!("{line}");
            printed.insert(line);
        }
    }
    Ok(())
}

/// Whether this is `impl TRAIT for TYPE`.
fn is_of_a_trait(item: &PublicItem) -> bool {
    let line = item.to_string();
    line.starts_with("impl") && line.contains(" for ")
}
