//! Checks that the modules of a crate are floors: in every folder, nothing uses what uses it.
//!
//! Reads the paths in the sources that begin with `crate`, `super` or `self`. A folder counts as a
//! whole for what is outside it. What a module and its own submodules use of each other does not
//! count, nor do unit tests.

use std::collections::{BTreeMap, BTreeSet};
use std::error::Error;
use std::fs;
use std::path::Path;
use std::process::ExitCode;

/// The names from the root of the crate to a module.
type Module = Vec<String>;
/// What each module or folder uses, and the modules in which it does so.
type Uses = BTreeMap<Module, BTreeMap<Module, BTreeSet<String>>>;

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let src = std::env::args().nth(1).ok_or("usage: modules SRC")?;
    let mut sources = BTreeMap::new();
    read(Path::new(&src), &mut Vec::new(), &mut sources)?;
    let modules: BTreeSet<Module> = sources.keys().cloned().collect();

    let mut uses = Uses::new();
    let mut unclear = Vec::new();
    for (module, source) in &sources {
        for path in paths(source, module) {
            let used = (0..=path.len()).rev().map(|len| &path[..len]);
            let used = used.into_iter().find(|&used| used.is_empty() || modules.contains(used));
            match used {
                Some([]) | None if !module.is_empty() => {
                    unclear.push(format!("{}: crate::{}", show(module), path.join("::")));
                }
                Some(used) => add(&mut uses, module, used),
                None => {}
            }
        }
    }
    for path in &unclear {
        println!("{path} is a re-export: name the module that has it");
    }
    let cycles = cycles(&mut uses);
    for (user, used) in &cycles {
        for (used, by) in used {
            let by: Vec<_> = by.iter().map(String::as_str).collect();
            println!("in a circle, {} uses {}: {}", show(user), show(used), by.join(", "));
        }
    }
    let fails = !unclear.is_empty() || !cycles.is_empty();
    if !fails {
        println!("{} modules, no cycle", modules.len());
    }
    Ok(ExitCode::from(u8::from(fails)))
}

/// Reads a folder's files. `mod.rs`, and the file beside the folder with its name, are the folder's
/// own module.
fn read(
    folder: &Path,
    module: &mut Module,
    sources: &mut BTreeMap<Module, String>,
) -> Result<(), Box<dyn Error>> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let name = path.file_stem().and_then(|name| name.to_str()).ok_or("a name in UTF-8")?;
        if path.is_dir() {
            module.push(name.to_owned());
            read(&path, module, sources)?;
            module.pop();
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let mut module = module.clone();
            if !["lib", "mod"].contains(&name) {
                module.push(name.to_owned());
            }
            sources.insert(module, without_tests(&fs::read_to_string(&path)?));
        }
    }
    Ok(())
}

/// Without comments, and without the unit tests at the foot.
fn without_tests(source: &str) -> String {
    let end = source.find("\nmod tests {").unwrap_or(source.len());
    let lines = source[..end].lines().map(|line| line.split("//").next().unwrap_or(""));
    lines.collect::<Vec<_>>().join("\n")
}

/// The paths in a module's source, from the root of the crate.
fn paths(source: &str, module: &Module) -> Vec<Module> {
    let tokens = tokens(source);
    let mut found = Vec::new();
    let mut at = 0;
    while at < tokens.len() {
        let starts = ["crate", "super", "self"].contains(&tokens[at]);
        let continues = at > 0 && tokens[at - 1] == "::";
        if starts && !continues && tokens.get(at + 1) == Some(&"::") {
            let here = if tokens[at] == "crate" { Module::new() } else { module.clone() };
            at = tree(&tokens, at, here, &mut found);
        } else {
            at += 1;
        }
    }
    found
}

/// Names and punctuation; `::` is one. Without what is in strings.
fn tokens(source: &str) -> Vec<&str> {
    let is_name = |c: char| c.is_alphanumeric() || c == '_';
    let mut tokens = Vec::new();
    let mut rest = source.trim_start();
    while let Some(first) = rest.chars().next() {
        let len = match first {
            c if is_name(c) => rest.find(|c| !is_name(c)).unwrap_or(rest.len()),
            _ if rest.starts_with("::") => 2,
            '"' => string(rest),
            '\'' if rest.starts_with("'\"'") => 3,
            c => c.len_utf8(),
        };
        tokens.push(&rest[..len]);
        rest = rest[len..].trim_start();
    }
    tokens
}

/// The length of the string literal that `source` begins with.
fn string(source: &str) -> usize {
    let mut escaped = false;
    let end = source.char_indices().skip(1).find(|&(_, c)| {
        let ends = c == '"' && !escaped;
        escaped = c == '\\' && !escaped;
        ends
    });
    end.map_or(source.len(), |(at, _)| at + 1)
}

/// Adds the paths of a tree such as `a::{b, c::d}`, below `path`. Returns where it ends.
fn tree(tokens: &[&str], mut at: usize, mut path: Module, found: &mut Vec<Module>) -> usize {
    loop {
        match tokens.get(at).copied().unwrap_or("") {
            "crate" | "self" => {}
            "super" => drop(path.pop()),
            "{" => {
                at += 1;
                while !["}", ""].contains(&tokens.get(at).copied().unwrap_or("")) {
                    at = tree(tokens, at, path.clone(), found);
                    // Behind what is left of an item, such as `as _`.
                    while !["}", ",", ""].contains(&tokens.get(at).copied().unwrap_or("")) {
                        at += 1;
                    }
                    at += usize::from(tokens.get(at) == Some(&","));
                }
                return at + 1;
            }
            name if name.starts_with(|c: char| c.is_alphabetic() || c == '_') => {
                path.push(name.to_owned());
            }
            // `*`, or generic arguments.
            _ => break,
        }
        at += 1;
        if tokens.get(at) != Some(&"::") {
            break;
        }
        at += 1;
    }
    // A macro that is exported is at the root as `$crate::name`, whichever module has it.
    if tokens.get(at) != Some(&"!")
        && !tokens[..at].ends_with(&["$", "crate", "::", tokens[at - 1]])
    {
        found.push(path);
    }
    at
}

/// Adds that a module uses another, to the folder in which they part.
fn add(uses: &mut Uses, user: &[String], used: &[String]) {
    let same = user.iter().zip(used).take_while(|(a, b)| a == b).count();
    if same < user.len() && same < used.len() {
        let [from, to] = [user, used].map(|module| module[..=same].to_vec());
        let by = format!("{} of {}", show(user), show(used));
        uses.entry(from).or_default().entry(to).or_default().insert(by);
    }
}

/// What is left without those that use nothing that is left, and those that nothing left uses.
fn cycles(uses: &mut Uses) -> Uses {
    loop {
        let before: usize = uses.values().map(BTreeMap::len).sum();
        let users: BTreeSet<Module> = uses.keys().cloned().collect();
        let used: BTreeSet<Module> = uses.values().flat_map(BTreeMap::keys).cloned().collect();
        uses.retain(|user, _| used.contains(user));
        uses.values_mut().for_each(|all| all.retain(|used, _| users.contains(used)));
        uses.retain(|_, all| !all.is_empty());
        if uses.values().map(BTreeMap::len).sum::<usize>() == before {
            return std::mem::take(uses);
        }
    }
}

fn show(module: &[String]) -> String {
    if module.is_empty() { "lib.rs".to_owned() } else { module.join("::") }
}
