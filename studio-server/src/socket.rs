//! The web socket of a page.

use crate::shared::Shared;
use axum::{
    extract::{
        State,
        ws::{Message, WebSocket, WebSocketUpgrade},
    },
    response::Response,
};
use std::{
    sync::{Arc, mpsc},
    thread,
    time::{Duration, Instant},
};
use studio::{Library, Reply, Viewer};
use tokio::sync::mpsc as channel;

/// A message of a page is at most so long, in bytes: champions and creatures are smaller.
const LONGEST_MESSAGE: usize = 16 << 20;

/// How often a page is told what is new.
const NEWS: Duration = Duration::from_millis(50);

pub(crate) async fn socket(State(shared): State<Arc<Shared>>, upgrade: WebSocketUpgrade) -> Response {
    let upgrade = upgrade.max_message_size(LONGEST_MESSAGE).max_frame_size(LONGEST_MESSAGE);
    upgrade.on_upgrade(move |socket| serve(socket, Arc::clone(&shared.library)))
}

/// Lets a viewer on a thread of its own answer a page, until the page is gone.
async fn serve(mut socket: WebSocket, library: Arc<Library>) {
    let (questions, asked) = mpsc::channel::<String>();
    let (answers, mut answered) = channel::unbounded_channel::<Reply>();
    let view = move || {
        let mut viewer = Viewer::new(library);
        let mut told = Instant::now();
        loop {
            let mut replies = match asked.recv_timeout(NEWS) {
                Ok(question) => viewer.answer(&question),
                Err(mpsc::RecvTimeoutError::Timeout) => Vec::new(),
                Err(mpsc::RecvTimeoutError::Disconnected) => return,
            };
            if told.elapsed() >= NEWS {
                told = Instant::now();
                replies.extend(viewer.news());
            }
            if replies.into_iter().any(|reply| answers.send(reply).is_err()) {
                return;
            }
        }
    };
    if let Err(error) = thread::Builder::new().name("page".into()).spawn(view) {
        tracing::error!(%error, "a page cannot be served");
        return;
    }
    loop {
        tokio::select! {
            message = socket.recv() => match message {
                Some(Ok(Message::Text(text))) => {
                    if questions.send(text.as_str().to_owned()).is_err() {
                        return;
                    }
                }
                Some(Ok(Message::Close(_)) | Err(_)) | None => return,
                Some(Ok(_)) => {}
            },
            reply = answered.recv() => {
                let message = match reply {
                    None => return,
                    Some(Reply::Frame(bytes)) => Message::Binary(bytes.into()),
                    Some(Reply::Event(event)) => match serde_json::to_string(&event) {
                        Ok(text) => Message::Text(text.into()),
                        Err(error) => {
                            tracing::error!(%error, "an event cannot be written");
                            continue;
                        }
                    },
                };
                if socket.send(message).await.is_err() {
                    return;
                }
            }
        }
    }
}
