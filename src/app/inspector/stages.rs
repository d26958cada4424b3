//! The cloud that is looked at, from its source to its analysis and the points that are shown.

use std::sync::Arc;

use crate::app::source::{Content, Source};
use crate::fruit::{Fruit, FruitError, PeduncleChoice, ReadErrorKind, Request};
use crate::geometry::{Cloud, Unit};
use crate::method::{Analysis, AnalysisError, Observe, Stages, Surface};
use crate::parallel::Watch;
use crate::view::ShownPoints;

#[derive(Debug, Clone, PartialEq)]
struct FruitKey {
    source: Source,
    unit: Option<Unit>,
    peduncle: PeduncleChoice,
}

/// Points from which on a cloud is shown before it is analyzed.
const LARGE: usize = 100_000;

/// The file, fruit and shown points of the cloud that is looked at, and the stages of its analysis: each
/// kept until something that it depends on changes. A copy shares everything.
#[derive(Debug, Clone, Default)]
pub struct FruitStages {
    content: Option<(Source, Content)>,
    fruit: Option<(FruitKey, Arc<Fruit>)>,
    /// A fruit's cloud without the peduncle's points.
    body: Option<(Arc<Fruit>, Cloud)>,
    /// The stages of the fruit's cloud or of its body, whichever was analyzed last.
    stages: Option<Stages>,
    /// The points before their analysis, which shares with them what it can.
    bare: Option<Arc<ShownPoints>>,
    shown: Option<(ShownKey, Arc<ShownPoints>)>,
}

/// The surface whose points are shown, the same one and not an equal one, and the unit that was asked for.
#[derive(Debug, Clone)]
struct ShownKey {
    surface: Arc<Surface>,
    unit: Option<Unit>,
}

/// A cloud with its analysis.
#[derive(Debug, Clone)]
pub struct AnalyzedFruit {
    /// The cloud.
    pub fruit: Arc<Fruit>,
    /// Its points as they are shown.
    pub shown: Arc<ShownPoints>,
    /// Its analysis.
    pub analysis: Arc<Analysis>,
    /// The analysis with the simulator's center given, if the truth tells it.
    pub at_true_center: Option<Arc<Analysis>>,
}

/// Why there is no analysis.
#[derive(Debug)]
pub enum AnalyzeError {
    /// The file gives no cloud.
    Fruit(FruitError),
    /// The cloud was read, and can be shown, but not analyzed.
    Analysis {
        /// The cloud.
        fruit: Arc<Fruit>,
        /// Its points.
        shown: Arc<ShownPoints>,
        /// The cause.
        error: AnalysisError,
    },
    /// The work was cancelled.
    Cancelled,
}

impl FruitStages {
    /// The analysis, if only scores have to be computed for it: τ, the aggregation and the partner
    /// fraction change nothing else.
    pub fn analyze_kept(&self, source: &Source, request: &Request) -> Option<AnalyzedFruit> {
        let fruit = kept(self.fruit.as_ref(), &FruitKey::new(source, request))?;
        let is_kept = |stages: &&Stages| {
            if request.without_peduncle {
                let body = self.body.as_ref().filter(|(of, _)| Arc::ptr_eq(of, &fruit));
                body.is_some_and(|(_, body)| stages.cloud().shares_points_with(body))
            } else {
                stages.cloud().shares_points_with(fruit.cloud())
            }
        };
        let stages = self.stages.as_ref().filter(is_kept)?;
        let params = request.params(&fruit);
        let analysis = stages.analyze_kept(&params)?;
        let at_true_center = match &fruit.truth {
            Some(truth) => Some(Arc::new(stages.analyze_kept(&params.with_center(truth.center))?)),
            None => None,
        };
        let shown = kept(self.shown.as_ref(), &ShownKey::new(request, &analysis))?;
        Some(AnalyzedFruit {
            analysis: Arc::new(analysis),
            at_true_center,
            fruit,
            shown,
        })
    }

    /// Reads and analyzes a cloud, running every stage whose result is not kept. The points of a large
    /// cloud are handed to `arrived` as soon as they are read, since their analysis takes a while.
    ///
    /// # Errors
    /// Returns an error if the file gives no cloud, the cloud cannot be analyzed, or the work is
    /// cancelled.
    pub fn analyze(
        &mut self,
        source: &Source,
        request: &Request,
        observe: &dyn Observe,
        arrived: &dyn Fn(&Arc<Fruit>, Arc<ShownPoints>),
    ) -> Result<AnalyzedFruit, AnalyzeError> {
        let key = FruitKey::new(source, request);
        let is_new = kept(self.fruit.as_ref(), &key).is_none();
        let fruit = self.fruit(key, observe)?;
        if is_new && fruit.cloud().len() >= LARGE {
            arrived(&fruit, self.bare(&fruit));
        }
        if observe.is_cancelled() {
            return Err(AnalyzeError::Cancelled);
        }
        let bare = self.bare(&fruit);
        let stages = self.stages(&fruit, request);
        let analysis = match stages.analyze(&request.params(&fruit), observe) {
            Ok(analysis) => Arc::new(analysis),
            Err(error) if error.is_cancelled() => return Err(AnalyzeError::Cancelled),
            Err(error) => {
                return Err(AnalyzeError::Analysis {
                    shown: bare,
                    fruit,
                    error,
                });
            }
        };
        let key = ShownKey::new(request, &analysis);
        let shown = kept(self.shown.as_ref(), &key)
            .unwrap_or_else(|| Arc::new(bare.analyzed(fruit.cloud(), &analysis)));
        self.shown = Some((key, shown.clone()));
        Ok(AnalyzedFruit {
            fruit,
            shown,
            analysis,
            at_true_center: None,
        })
    }

    /// Adds the analysis with the true center given, where the simulator's truth tells it, to one that
    /// [`FruitStages::analyze`] has just made.
    ///
    /// # Errors
    /// Returns an error if the work is cancelled.
    pub fn with_true_center(
        &mut self,
        mut analyzed: AnalyzedFruit,
        observe: &dyn Observe,
    ) -> Result<AnalyzedFruit, AnalyzeError> {
        if let (Some(truth), Some(stages)) = (&analyzed.fruit.truth, &mut self.stages) {
            let params = analyzed.analysis.params.with_center(truth.center);
            analyzed.at_true_center = match stages.analyze(&params, observe) {
                Ok(analysis) => Some(Arc::new(analysis)),
                Err(error) if error.is_cancelled() => return Err(AnalyzeError::Cancelled),
                Err(_) => None,
            };
        }
        Ok(analyzed)
    }

    fn fruit(&mut self, key: FruitKey, watch: &dyn Watch) -> Result<Arc<Fruit>, AnalyzeError> {
        if let Some(fruit) = kept(self.fruit.as_ref(), &key) {
            return Ok(fruit);
        }
        let content = match kept(self.content.as_ref(), &key.source) {
            Some(content) => content,
            None => key.source.read(watch).map_err(|error| match error.kind {
                ReadErrorKind::Cancelled => AnalyzeError::Cancelled,
                _ => AnalyzeError::Fruit(error.into()),
            })?,
        };
        self.content = Some((key.source.clone(), content.clone()));
        let mut fruit = Fruit::from_file_lenient(&content.file, key.unit, &key.peduncle);
        if let Some(truth) = &content.truth {
            fruit = fruit.with_truth(key.source.path(), truth);
        }
        let fruit = Arc::new(fruit);
        self.fruit = Some((key, fruit.clone()));
        Ok(fruit)
    }

    /// The stages of the cloud that is to be analyzed.
    fn stages(&mut self, fruit: &Arc<Fruit>, request: &Request) -> &mut Stages {
        let cloud = if request.without_peduncle {
            self.body(fruit)
        } else {
            fruit.cloud().clone()
        };
        let is_same = |stages: &Stages| stages.cloud().shares_points_with(&cloud);
        let kept = self.stages.take().filter(is_same);
        self.stages.insert(kept.unwrap_or_else(|| Stages::new(cloud)))
    }

    fn body(&mut self, fruit: &Arc<Fruit>) -> Cloud {
        let kept = self.body.take().filter(|(of, _)| Arc::ptr_eq(of, fruit));
        let (_, body) = self
            .body
            .insert(kept.unwrap_or_else(|| (fruit.clone(), fruit.body())));
        body.clone()
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

impl ShownKey {
    fn new(request: &Request, analysis: &Analysis) -> Self {
        Self {
            surface: analysis.surface.clone(),
            unit: request.unit,
        }
    }
}

impl PartialEq for ShownKey {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.surface, &other.surface) && self.unit == other.unit
    }
}

fn kept<K: PartialEq, V: Clone>(stage: Option<&(K, V)>, key: &K) -> Option<V> {
    stage.filter(|(k, _)| k == key).map(|(_, value)| value.clone())
}
