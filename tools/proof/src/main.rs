//! Long proofs of what unitpack promises, one command each.

mod codes;
mod nearest;

use std::error::Error;
use std::process::ExitCode;

use lexopt::{Arg, Parser};

const USAGE: &str = "\
Usage: proof COMMAND [OPTION]... [FORMAT]...
Proves what unitpack promises of the formats named, or of all.

codes     every code of formats of at most 32 bits: unit length, the exact direction, one result in a
          batch and alone, and canonical when encoded again; negated and mirrored as its vector is, above
          24 bits one code in 61
  --journal FILE   what was done, to go on from there [codes.journal]
  --output FILE    the table of the formats that are done [codes.csv]
  --slice K        only slice K modulo 256 of each format, without journal and table

nearest   whether encode_precise gives the nearest of all codes
  --directions N   [10000000]
  --seed S         [1]
  --output FILE    keep a row for each format there; without FORMAT, skip those that have one
  --windows        formats of 25 to 32 bits against the codes around each direction, not all
  --fast           encode instead, which must fail

  --threads T      [all cores]
";

fn main() -> ExitCode {
    match run(Parser::from_env()) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("proof: {error}\n\n{USAGE}");
            ExitCode::from(2)
        }
    }
}

/// Gives whether everything held.
fn run(mut arguments: Parser) -> Result<bool, Box<dyn Error>> {
    match arguments.next()? {
        Some(Arg::Value(command)) if command == "codes" => codes::run(arguments),
        Some(Arg::Value(command)) if command == "nearest" => nearest::run(arguments),
        Some(Arg::Long("help")) => {
            print!("{USAGE}");
            Ok(true)
        }
        Some(argument) => Err(argument.unexpected().into()),
        None => Err("which proof?".into()),
    }
}
