//! The program: everything is in the library, for programs that add to it.

use std::process::ExitCode;

fn main() -> ExitCode {
    gambol::program(&gambol::Registry::default())
}
