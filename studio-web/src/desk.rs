//! Where pieces of generations are handed out to the helpers of a browser, and brought back.

use gambol_runs::{champion::Champion, config::RunConfig, training::Batch};
use ne_core::Evaluation;
use serde::{Deserialize, Serialize};
use std::{
    collections::{BTreeMap, BTreeSet},
    ops::Range,
    sync::{Arc, Mutex, MutexGuard, PoisonError},
    time::{Duration, Instant},
};
use studio::{
    protocol::Verdict,
    work::{Helpers, Ticket, Workers},
};

/// Hands out pieces.
pub struct Desk {
    inner: Mutex<Inner>,
    workers: Arc<dyn Workers>,
}

#[derive(Default)]
struct Inner {
    /// The helpers that have come, each with the number of the configuration it was sent last.
    helpers: BTreeMap<u32, Option<u64>>,
    /// The helpers without an errand.
    idle: BTreeSet<u32>,
    offers: BTreeMap<Ticket, Offer>,
    judgements: BTreeMap<Ticket, Judgement>,
    tickets: Ticket,
    /// The latest configuration, and its number.
    config: Option<(u64, Arc<RunConfig>)>,
}

struct Offer {
    config: (u64, Arc<RunConfig>),
    batch: Batch,
    pieces: Vec<Piece>,
}

struct Piece {
    of: Range<usize>,
    lent: Option<Lent>,
    found: Option<Vec<Evaluation>>,
}

/// Since when, and to which helper; `None`: to the owner of the batch.
struct Lent {
    since: Instant,
    to: Option<u32>,
}

/// What a helper is sent to do.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Errand {
    /// Evaluate a piece of a batch.
    Evaluate {
        /// The batch.
        ticket: Ticket,
        /// Which piece of it.
        piece: usize,
        /// What it is evaluated by, if that is new.
        config: Option<Arc<RunConfig>>,
        /// The nets.
        batch: Batch,
    },
    /// Judge a champion.
    Judge {
        /// The champion's.
        ticket: Ticket,
        /// The champion.
        champion: Arc<Champion>,
    },
}

/// What comes back.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Found {
    /// Of a piece.
    Evaluations {
        /// The batch.
        ticket: Ticket,
        /// Which piece of it.
        piece: usize,
        /// One for each net.
        evaluations: Vec<Evaluation>,
    },
    /// Of a champion.
    Verdict {
        /// The champion's.
        ticket: Ticket,
        /// The verdict.
        verdict: Verdict,
    },
}

/// A champion that waits for its verdict.
struct Judgement {
    champion: Arc<Champion>,
    lent: Option<Lent>,
    verdict: Option<Verdict>,
}

/// Pieces of a batch for each worker: several, so that a faster worker does more of them.
const PIECES_EACH: usize = 4;

/// Fewer nets are not worth the way.
const SMALLEST: usize = 4;

/// After so long a helper is taken to be gone, and its piece is evaluated by another.
const LOST: Duration = Duration::from_secs(3);

impl Desk {
    /// A desk without helpers. It wakes `workers` when a helper comes or brings something back.
    pub fn new(workers: Arc<dyn Workers>) -> Self {
        Self { inner: Mutex::default(), workers }
    }

    /// A helper comes, or says that it has nothing to do.
    pub fn welcome(&self, helper: u32) {
        {
            let mut inner = self.inner();
            inner.helpers.entry(helper).or_default();
            inner.idle.insert(helper);
        }
        self.workers.wake();
    }

    /// A helper goes, and with it what it was sent.
    pub fn dismiss(&self, helper: u32) {
        let mut inner = self.inner();
        inner.helpers.remove(&helper);
        inner.idle.remove(&helper);
        let Inner { offers, judgements, .. } = &mut *inner;
        let pieces = offers.values_mut().flat_map(|offer| &mut offer.pieces).map(|piece| &mut piece.lent);
        for lent in pieces.chain(judgements.values_mut().map(|judgement| &mut judgement.lent)) {
            lent.take_if(|lent| lent.to == Some(helper));
        }
    }

    /// Something for a helper that has nothing to do.
    pub fn errand(&self) -> Option<(u32, Errand)> {
        let mut inner = self.inner();
        let helper = *inner.idle.first()?;
        let errand = inner.judgement(helper).or_else(|| inner.piece(helper))?;
        inner.idle.remove(&helper);
        Some((helper, errand))
    }

    /// A helper brings something back, and has nothing to do.
    pub fn bring(&self, helper: u32, found: Found) {
        self.welcome(helper);
        match found {
            Found::Evaluations { ticket, piece, evaluations } => self.give(ticket, piece, evaluations),
            Found::Verdict { ticket, verdict } => {
                if let Some(judgement) = self.inner().judgements.get_mut(&ticket) {
                    judgement.verdict = Some(verdict);
                }
            }
        }
        self.workers.wake();
    }

    fn inner(&self) -> MutexGuard<'_, Inner> {
        self.inner.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Inner {
    fn judgement(&mut self, helper: u32) -> Option<Errand> {
        let is_open = |judgement: &Judgement| judgement.verdict.is_none() && judgement.lent.is_none();
        let (&ticket, judgement) = self.judgements.iter_mut().find(|(_, judgement)| is_open(judgement))?;
        judgement.lent = Some(Lent { since: Instant::now(), to: Some(helper) });
        Some(Errand::Judge { ticket, champion: Arc::clone(&judgement.champion) })
    }

    fn piece(&mut self, helper: u32) -> Option<Errand> {
        let open = |offer: &Offer| offer.pieces.iter().position(Piece::is_open);
        let (&ticket, piece) = self.offers.iter().find_map(|(ticket, offer)| Some((ticket, open(offer)?)))?;
        let offer = self.offers.get_mut(&ticket)?;
        let batch = offer.lend(piece, Some(helper));
        let (number, config) = offer.config.clone();
        let known = self.helpers.get_mut(&helper)?.replace(number);
        Some(Errand::Evaluate { ticket, piece, config: (known != Some(number)).then_some(config), batch })
    }
}

impl Piece {
    /// Nothing evaluates it, or for too long.
    fn is_open(&self) -> bool {
        self.found.is_none() && self.lent.as_ref().is_none_or(|lent| lent.since.elapsed() > LOST)
    }
}

impl Offer {
    fn lend(&mut self, piece: usize, to: Option<u32>) -> Batch {
        self.pieces[piece].lent = Some(Lent { since: Instant::now(), to });
        let networks = self.batch.networks[self.pieces[piece].of.clone()].to_vec();
        let Batch { rung, seed, .. } = self.batch;
        Batch { rung, networks, seed }
    }
}

impl Helpers for Desk {
    fn are_there(&self) -> bool {
        !self.inner().helpers.is_empty()
    }

    fn offer(&self, config: &RunConfig, batch: Batch) -> Ticket {
        let mut inner = self.inner();
        let known = inner.config.clone().filter(|(_, known)| **known == *config);
        inner.tickets += 1;
        let ticket = inner.tickets;
        let config = known.unwrap_or_else(|| (ticket, Arc::new(config.clone())));
        inner.config = Some(config.clone());
        let count = batch.networks.len();
        let size = count.div_ceil((inner.helpers.len() + 1) * PIECES_EACH).max(SMALLEST);
        let piece = |from: usize| Piece { of: from..(from + size).min(count), lent: None, found: None };
        let pieces = (0..count).step_by(size).map(piece).collect();
        inner.offers.insert(ticket, Offer { config, batch, pieces });
        ticket
    }

    fn collect(&self, ticket: Ticket) -> Option<Vec<Evaluation>> {
        let mut inner = self.inner();
        if inner.offers.get(&ticket)?.pieces.iter().any(|piece| piece.found.is_none()) {
            return None;
        }
        let offer = inner.offers.remove(&ticket)?;
        Some(offer.pieces.into_iter().filter_map(|piece| piece.found).flatten().collect())
    }

    fn take(&self, ticket: Ticket) -> Option<(usize, Batch)> {
        let mut inner = self.inner();
        let offer = inner.offers.get_mut(&ticket)?;
        let piece = offer.pieces.iter().rposition(Piece::is_open)?;
        Some((piece, offer.lend(piece, None)))
    }

    fn give(&self, ticket: Ticket, piece: usize, evaluations: Vec<Evaluation>) {
        let mut inner = self.inner();
        let piece = inner.offers.get_mut(&ticket).and_then(|offer| offer.pieces.get_mut(piece));
        // Another worker may have evaluated the piece meanwhile, or the batch was withdrawn.
        if let Some(piece) = piece.filter(|piece| piece.found.is_none() && evaluations.len() == piece.of.len()) {
            piece.found = Some(evaluations);
        }
    }

    fn judge(&self, champion: &Champion) -> Ticket {
        let mut inner = self.inner();
        inner.tickets += 1;
        let ticket = inner.tickets;
        let judgement = Judgement { champion: Arc::new(champion.clone()), lent: None, verdict: None };
        inner.judgements.insert(ticket, judgement);
        ticket
    }

    fn verdict(&self, ticket: Ticket) -> Option<Verdict> {
        let mut inner = self.inner();
        let verdict = inner.judgements.get(&ticket)?.verdict.clone()?;
        inner.judgements.remove(&ticket);
        Some(verdict)
    }

    fn withdraw(&self, ticket: Ticket) {
        let mut inner = self.inner();
        inner.offers.remove(&ticket);
        inner.judgements.remove(&ticket);
    }
}
