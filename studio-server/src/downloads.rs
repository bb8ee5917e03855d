//! What a page asks for by an address: the page itself, reports, champions and exports.

use crate::shared::Shared;
use axum::{
    body::Body,
    extract::{Path, State},
    http::{StatusCode, header},
    response::{IntoResponse, Response},
};
use gambol_exports::{Format, Options, Picture};
use gambol_runs::{champion::Champion, run_folder::RunFolder};
use std::{fmt::Display, sync::Arc};

pub(crate) async fn page() -> Response {
    ([(header::CONTENT_TYPE, "text/html; charset=utf-8")], studio::page::PAGE).into_response()
}

pub(crate) async fn script() -> Response {
    ([(header::CONTENT_TYPE, "text/javascript; charset=utf-8")], studio::page::scripts()).into_response()
}

pub(crate) async fn style() -> Response {
    ([(header::CONTENT_TYPE, "text/css; charset=utf-8")], studio::page::styles()).into_response()
}

/// What a page asked for by its address, done on a thread of its own.
async fn done(work: impl FnOnce() -> Result<Response, Failed> + Send + 'static) -> Response {
    let done = tokio::task::spawn_blocking(work).await;
    match done {
        Ok(Ok(response)) => response,
        Ok(Err(failed)) => failed.into_response(),
        Err(error) => Failed::from(error).into_response(),
    }
}

/// Why a request has failed: a status and a text.
struct Failed(StatusCode, String);

impl<E: Display> From<E> for Failed {
    fn from(error: E) -> Self {
        Self(StatusCode::UNPROCESSABLE_ENTITY, error.to_string())
    }
}

impl IntoResponse for Failed {
    fn into_response(self) -> Response {
        (self.0, format!("{}\n", self.1)).into_response()
    }
}

const NO_CHAMPION: &str = "there is no champion yet";

fn folder_of(shared: &Shared, run: &str) -> Result<RunFolder, Failed> {
    shared.library.folder(run).map_err(|error| Failed(StatusCode::NOT_FOUND, error.to_string()))
}

pub(crate) async fn report(State(shared): State<Arc<Shared>>, Path((_, run)): Path<(String, String)>) -> Response {
    done(move || {
        let folder = folder_of(&shared, &run)?;
        if shared.library.state(&run).is_some() || !folder.report().is_file() {
            gambol_reports::report::write_report(&folder, shared.library.registry(), None)?;
        }
        let page = std::fs::read(folder.report())?;
        // The page's own policy stands in it, and lets in nothing but itself.
        let policy = "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:; frame-ancestors 'none'";
        let headers = [(header::CONTENT_TYPE, "text/html; charset=utf-8"), (header::CONTENT_SECURITY_POLICY, policy)];
        Ok((headers, page).into_response())
    })
    .await
}

pub(crate) async fn champion(State(shared): State<Arc<Shared>>, Path((_, run)): Path<(String, String)>) -> Response {
    done(move || {
        let folder = folder_of(&shared, &run)?;
        let bytes = std::fs::read(folder.champion()).map_err(|_| NO_CHAMPION)?;
        Ok(attachment(&format!("{run}.json"), bytes))
    })
    .await
}

pub(crate) async fn verify(State(shared): State<Arc<Shared>>, Path((_, run)): Path<(String, String)>) -> Response {
    done(move || {
        let champion = champion_of(&shared, &run)?;
        let verification = champion.verify(shared.library.registry())?;
        let text = serde_json::json!({ "identical": verification.is_identical(), "diverges_at_step": verification.diverges_at });
        Ok(([(header::CONTENT_TYPE, "application/json")], text.to_string()).into_response())
    })
    .await
}

pub(crate) async fn export(
    State(shared): State<Arc<Shared>>,
    Path((_, run, format, file)): Path<(String, String, String, usize)>,
) -> Response {
    done(move || {
        let known = Format::ALL.into_iter().find(|known| known.name() == format);
        let format = known.ok_or_else(|| format!("there is no format \"{format}\""))?;
        let champion = champion_of(&shared, &run)?;
        let options = Options { name: run.clone(), steps: None, picture: Picture::default() };
        let exported = gambol_exports::export(&champion, shared.library.registry(), format, &options);
        let files = exported?;
        let count = files.len();
        let exported = files.into_iter().nth(file).ok_or_else(|| format!("there are {count} files"))?;
        Ok(attachment(&format!("{run}{}", exported.ending), exported.bytes))
    })
    .await
}

fn champion_of(shared: &Shared, run: &str) -> Result<Champion, Failed> {
    let folder = folder_of(shared, run)?;
    if !folder.champion().is_file() {
        return Err(NO_CHAMPION.into());
    }
    Ok(Champion::read(&folder.champion())?)
}

/// A file to be saved. Its name is that of a folder, which may have any sign in it.
fn attachment(name: &str, bytes: Vec<u8>) -> Response {
    let is_plain = |sign: char| sign.is_ascii_alphanumeric() || "-_. ".contains(sign);
    let name: String = name.chars().map(|sign| if is_plain(sign) { sign } else { '_' }).collect();
    let disposition = format!("attachment; filename=\"{name}\"");
    let headers =
        [(header::CONTENT_TYPE, "application/octet-stream".to_owned()), (header::CONTENT_DISPOSITION, disposition)];
    (headers, Body::from(bytes)).into_response()
}
