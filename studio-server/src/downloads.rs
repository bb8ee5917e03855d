//! What a page asks for by an address: the page itself, reports, champions and exports.

use crate::shared::Shared;
use axum::{
    body::Body,
    extract::{Path, State},
    http::{HeaderMap, HeaderValue, StatusCode, header},
    response::{IntoResponse, Response},
};
use std::sync::Arc;
use studio::{Download, DownloadError, Wanted, page};

pub(crate) async fn index() -> Response {
    ([(header::CONTENT_TYPE, "text/html; charset=utf-8")], page::PAGE).into_response()
}

pub(crate) async fn script() -> Response {
    ([(header::CONTENT_TYPE, "text/javascript; charset=utf-8")], page::scripts(page::SERVED)).into_response()
}

pub(crate) async fn style() -> Response {
    ([(header::CONTENT_TYPE, "text/css; charset=utf-8")], page::styles()).into_response()
}

/// Of a run, on a thread of its own: it may take a while.
pub(crate) async fn download(
    State(shared): State<Arc<Shared>>,
    Path((_, run, wanted)): Path<(String, String, String)>,
) -> Response {
    let work = move || shared.library.download(&run, &Wanted::parse(&wanted)?);
    match tokio::task::spawn_blocking(work).await {
        Ok(Ok(download)) => response(download),
        Ok(Err(error)) => {
            let status = match error {
                DownloadError::Missing(_) => StatusCode::NOT_FOUND,
                _ => StatusCode::UNPROCESSABLE_ENTITY,
            };
            (status, format!("{error}\n")).into_response()
        }
        Err(error) => (StatusCode::INTERNAL_SERVER_ERROR, format!("{error}\n")).into_response(),
    }
}

/// A report's own policy stands in it, and lets in nothing but itself. But the file may be of somebody else: what runs in it is kept
/// from what the studio may do, in an origin of its own.
const REPORT_POLICY: &str = "sandbox allow-scripts allow-downloads; default-src 'none'; script-src 'unsafe-inline'; \
                             style-src 'unsafe-inline'; img-src data:; frame-ancestors 'none'";

fn response(download: Download) -> Response {
    let mut headers = HeaderMap::new();
    headers.insert(header::CONTENT_TYPE, HeaderValue::from_static(download.media));
    match download.name {
        // Letters, digits and a few signs.
        Some(name) => {
            if let Ok(disposition) = HeaderValue::from_str(&format!("attachment; filename=\"{name}\"")) {
                headers.insert(header::CONTENT_DISPOSITION, disposition);
            }
        }
        None => {
            headers.insert(header::CONTENT_SECURITY_POLICY, HeaderValue::from_static(REPORT_POLICY));
        }
    }
    (headers, Body::from(download.bytes)).into_response()
}
