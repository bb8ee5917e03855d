//! What the program promises to its users: which files, which bytes, which exit codes, which messages.
//!
//! Every test starts the program itself, in a temporary folder, on runs so small that they take a blink.

mod bad_creatures;
mod bad_files;
mod bad_settings;
mod benchmarks;
mod broken_runs;
mod champion_selection;
mod checking;
mod coaching;
mod comparing;
mod damage;
mod engines;
mod exporting;
mod film;
mod folder;
mod forgetting;
mod front;
mod full_disk;
mod further_bodies;
mod gait;
mod giving_up;
mod going_on;
mod help;
mod holding;
mod hostile;
mod interrupted;
mod killed;
mod large;
mod longer;
mod overwriting;
mod playing;
mod program;
mod repeating;
mod replaying;
mod reporting;
mod reproduce;
mod robust;
mod shaping;
mod strategies;
mod successive_halving;
mod swimming;
mod terrain;
mod training;
mod training_bench;
mod verifying;
