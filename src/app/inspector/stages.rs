//! The stages of the cloud that is looked at, each kept until something that it depends on changes.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::DVec3;

use crate::fruit::Request;
use crate::fruit::{
    CloudFile, Fruit, FruitError, PeduncleChoice, ReadError, ReadErrorKind, parse_cloud, read_cloud_watched,
};
use crate::geometry::Unit;
use crate::method::{
    Analysis, AnalysisError, CandidateGrid, CenterMethod, Filters, NormalSource, Observe, Params, PlaneTerms,
    Stage, UsedPoints, find_center, plane_terms, used_points,
};
use crate::parallel::Watch;
use crate::view::ShownPoints;

use crate::app::samples::Sample;

/// Where a cloud comes from.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Source {
    /// A file on disk.
    File(PathBuf),
    /// A sample that the program brings along.
    Bundled(Sample),
}

impl Source {
    /// What to call it.
    pub fn path(&self) -> &Path {
        match self {
            Self::File(path) => path,
            Self::Bundled(sample) => Path::new(sample.path()),
        }
    }

    /// Its last part, for lists and titles.
    pub fn name(&self) -> String {
        let path = self.path();
        path.file_name()
            .unwrap_or(path.as_os_str())
            .to_string_lossy()
            .into_owned()
    }

    fn read(&self, watch: &dyn Watch) -> Result<CloudFile, ReadError> {
        match self {
            Self::File(path) => read_cloud_watched(path, watch),
            Self::Bundled(sample) => parse_cloud(sample.path(), sample.bytes()),
        }
    }
}

#[derive(Debug, Clone, PartialEq)]
struct FruitKey {
    source: Source,
    unit: Option<Unit>,
    peduncle: PeduncleChoice,
}

#[derive(Debug, Clone, PartialEq)]
struct UsedKey {
    fruit: FruitKey,
    without_peduncle: bool,
    filters: Filters,
    normals: NormalSource,
    k: NonZeroUsize,
    viewpoint: DVec3,
}

#[derive(Debug, Clone, PartialEq)]
struct CenterKey {
    used: UsedKey,
    center: CenterMethod,
}

#[derive(Debug, Clone, PartialEq)]
struct PlanesKey {
    used: UsedKey,
    center: DVec3,
    u: usize,
}

/// Points from which on a cloud is shown before it is analyzed.
const LARGE: usize = 100_000;

/// Grids that are kept, so that going back to one is at once.
const KEPT_GRIDS: usize = 12;

/// What was computed, under what it was computed from. A copy shares everything.
#[derive(Debug, Clone, Default)]
pub struct Stages {
    file: Option<(Source, Arc<CloudFile>)>,
    fruit: Option<(FruitKey, Arc<Fruit>)>,
    used: Option<(UsedKey, Arc<UsedPoints>)>,
    /// The points before their analysis, of which that shares what it can.
    bare: Option<Arc<ShownPoints>>,
    shown: Option<(UsedKey, Arc<ShownPoints>)>,
    center: Option<(CenterKey, DVec3)>,
    /// The newest last.
    planes: Vec<(PlanesKey, Arc<PlaneTerms>)>,
}

/// A cloud with its analysis.
#[derive(Debug, Clone)]
pub struct Walked {
    /// The cloud.
    pub fruit: Arc<Fruit>,
    /// Its points as they are shown.
    pub shown: Arc<ShownPoints>,
    /// Its analysis.
    pub analysis: Arc<Analysis>,
}

/// Why there is no analysis, and how far it came.
#[derive(Debug)]
pub enum WalkError {
    /// The file gives no cloud.
    Fruit(FruitError),
    /// The cloud was read, and can be shown, but not analyzed.
    Analysis {
        /// The cloud.
        fruit: Arc<Fruit>,
        /// Its points.
        shown: Arc<ShownPoints>,
        /// Why.
        error: AnalysisError,
    },
    /// The work was called off.
    Cancelled,
}

impl Stages {
    /// The analysis, where only scores have to be computed for it: τ, the aggregation and the partner
    /// fraction change nothing else.
    pub fn at_once(&self, source: &Source, request: &Request) -> Option<Walked> {
        let fruit_key = FruitKey::new(source, request);
        let fruit = kept(self.fruit.as_ref(), &fruit_key)?;
        let params = request.params(&fruit);
        params.check().ok()?;
        let used_key = UsedKey::new(fruit_key, request, &params);
        let used = kept(self.used.as_ref(), &used_key)?;
        let shown = kept(self.shown.as_ref(), &used_key)?;
        let center = match params.center {
            CenterMethod::Given(center) => center,
            method => {
                let key = CenterKey {
                    used: used_key.clone(),
                    center: method,
                };
                kept(self.center.as_ref(), &key)?
            }
        };
        let planes = self.planes_of(&PlanesKey {
            used: used_key,
            center,
            u: params.u,
        })?;
        Some(Walked {
            analysis: Arc::new(Analysis::of_stages(&params, &used, center, planes)),
            fruit,
            shown,
        })
    }

    /// Walks the cloud through every stage whose result is not kept. The points of a large cloud are
    /// handed to `arrived` as soon as they are read: their analysis takes a while.
    ///
    /// # Errors
    /// Where the file gives no cloud, the cloud cannot be analyzed, or the work is called off.
    pub fn walk(
        &mut self,
        source: &Source,
        request: &Request,
        observe: &dyn Observe,
        arrived: &dyn Fn(&Arc<Fruit>, Arc<ShownPoints>),
    ) -> Result<Walked, WalkError> {
        let fruit_key = FruitKey::new(source, request);
        let is_new = kept(self.fruit.as_ref(), &fruit_key).is_none();
        let fruit = self.fruit(&fruit_key, observe)?;
        if is_new && fruit.cloud().len() >= LARGE {
            arrived(&fruit, self.bare(&fruit));
        }
        if observe.is_cancelled() {
            return Err(WalkError::Cancelled);
        }
        let bare = self.bare(&fruit);
        self.analyzed(fruit_key, &fruit, request, observe)
            .map_err(|error| {
                if error.is_cancelled() {
                    return WalkError::Cancelled;
                }
                WalkError::Analysis {
                    shown: bare,
                    fruit,
                    error,
                }
            })
    }

    fn fruit(&mut self, key: &FruitKey, watch: &dyn Watch) -> Result<Arc<Fruit>, WalkError> {
        if let Some(fruit) = kept(self.fruit.as_ref(), key) {
            return Ok(fruit);
        }
        let file = match kept(self.file.as_ref(), &key.source) {
            Some(file) => file,
            None => Arc::new(key.source.read(watch).map_err(|error| match error.kind {
                ReadErrorKind::Cancelled => WalkError::Cancelled,
                _ => WalkError::Fruit(error.into()),
            })?),
        };
        self.file = Some((key.source.clone(), file.clone()));
        let mut fruit = Fruit::from_file_lenient(&file, key.unit, &key.peduncle);
        if let Source::Bundled(sample) = key.source {
            fruit = fruit.with_truth(key.source.path(), sample.truth());
        }
        let fruit = Arc::new(fruit);
        self.fruit = Some((key.clone(), fruit.clone()));
        Ok(fruit)
    }

    fn analyzed(
        &mut self,
        fruit_key: FruitKey,
        fruit: &Arc<Fruit>,
        request: &Request,
        observe: &dyn Observe,
    ) -> Result<Walked, AnalysisError> {
        let params = request.params(fruit);
        params.check()?;
        let grid = CandidateGrid::new(params.u)?;
        let used_key = UsedKey::new(fruit_key, request, &params);
        let used = if let Some(used) = kept(self.used.as_ref(), &used_key) {
            used
        } else {
            let used = if request.without_peduncle {
                used_points(&fruit.body(), &params, observe)?
            } else {
                used_points(fruit.cloud(), &params, observe)?
            };
            let used = Arc::new(used);
            self.used = Some((used_key.clone(), used.clone()));
            used
        };
        observe.entered(Stage::Center);
        let center_key = CenterKey {
            used: used_key.clone(),
            center: params.center,
        };
        let center = match kept(self.center.as_ref(), &center_key) {
            Some(center) => center,
            None => find_center(used.surface.points(), &params.center, observe)?,
        };
        // A center that is dragged about does not push out the one that took a search.
        if !matches!(params.center, CenterMethod::Given(_)) {
            self.center = Some((center_key, center));
        }
        let planes_key = PlanesKey {
            used: used_key.clone(),
            center,
            u: params.u,
        };
        let planes = if let Some(planes) = self.planes_of(&planes_key) {
            planes
        } else {
            observe.entered(Stage::PlaneTerms);
            let terms = plane_terms(
                &used.surface,
                params.unit,
                center,
                params.viewpoint,
                grid,
                observe,
            )?;
            let terms = Arc::new(terms);
            self.planes.retain(|(key, _)| key.used == used_key);
            self.planes.push((planes_key, terms.clone()));
            if self.planes.len() > KEPT_GRIDS {
                self.planes.remove(0);
            }
            terms
        };
        observe.entered(Stage::Scores);
        let analysis = Arc::new(Analysis::of_stages(&params, &used, center, planes));
        let shown = match kept(self.shown.as_ref(), &used_key) {
            Some(shown) => shown,
            None => Arc::new(self.bare(fruit).analyzed(fruit.cloud(), &analysis)),
        };
        self.shown = Some((used_key, shown.clone()));
        Ok(Walked {
            fruit: fruit.clone(),
            shown,
            analysis,
        })
    }

    fn bare(&mut self, fruit: &Fruit) -> Arc<ShownPoints> {
        let positions = fruit.cloud().shared_positions();
        let kept = self.bare.as_ref();
        if let Some(bare) = kept.filter(|bare| Arc::ptr_eq(&bare.positions, &positions)) {
            return bare.clone();
        }
        let bare = Arc::new(ShownPoints::bare(fruit.cloud()));
        self.bare = Some(bare.clone());
        bare
    }

    fn planes_of(&self, key: &PlanesKey) -> Option<Arc<PlaneTerms>> {
        let found = self.planes.iter().find(|(k, _)| k == key);
        found.map(|(_, planes)| planes.clone())
    }
}

impl FruitKey {
    fn new(source: &Source, request: &Request) -> Self {
        Self {
            source: source.clone(),
            unit: request.unit,
            peduncle: request.peduncle.clone(),
        }
    }
}

impl UsedKey {
    /// `params` are the request's, settled for the fruit.
    fn new(mut fruit: FruitKey, request: &Request, params: &Params) -> Self {
        if !request.without_peduncle {
            // Where its points stay in, it does not matter which they are.
            fruit.peduncle = PeduncleChoice::Auto;
        }
        Self {
            fruit,
            without_peduncle: request.without_peduncle,
            filters: params.filters,
            normals: params.normals,
            k: params.k,
            viewpoint: params.viewpoint,
        }
    }
}

fn kept<K: PartialEq, V: Clone>(stage: Option<&(K, V)>, key: &K) -> Option<V> {
    stage.filter(|(k, _)| k == key).map(|(_, value)| value.clone())
}
