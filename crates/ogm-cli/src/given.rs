//! What the command line says about where maps lie.

use std::path::Path;

use ogm_core::Se2;
use ogm_merge::{KnownPose, Prior};

use crate::args::SearchArgs;
use crate::named::poses_of;
use crate::pose::transform;
use crate::usage::UsageError;

/// Poses that are known, exactly or not, of some of the maps.
#[derive(Debug)]
pub(crate) struct Given {
    /// The map in whose frame they are.
    reference: usize,
    exact: Vec<Option<Se2>>,
    believed: Vec<Option<Se2>>,
    /// Of what is believed, metres and radians.
    sigma: [f64; 2],
}

impl Given {
    /// From the values of `--transform` and `--prior`.
    pub(crate) fn new(
        maps: &[&Path],
        reference: usize,
        transforms: &[String],
        args: &SearchArgs,
    ) -> Result<Self, UsageError> {
        let exact = poses_of("--transform", maps, transforms)?;
        let named: Vec<String> =
            args.priors.iter().filter(|arg| arg.contains('=')).cloned().collect();
        let mut believed = poses_of("--prior", maps, &named)?;
        for argument in args.priors.iter().filter(|argument| !argument.contains('=')) {
            let wrong = |what: String| UsageError(format!("--prior {argument}: {what}"));
            let pose = transform(argument).map_err(wrong)?;
            let [first, second] = &mut believed[..] else {
                return Err(wrong("of more than two maps, write MAP.yaml=X,Y,DEG".to_owned()));
            };
            let other = if reference == 0 { second } else { first };
            if other.replace(pose).is_some() {
                return Err(wrong("this map has a pose already".to_owned()));
            }
        }
        if believed[reference].is_some() {
            let name = maps[reference].display();
            let message =
                format!("--prior of {name}, whose frame is kept, says nothing; name others");
            return Err(UsageError(message));
        }
        let both = maps.iter().zip(exact.iter().zip(&believed));
        if let Some((map, _)) = both.clone().find(|(_, (a, b))| a.is_some() && b.is_some()) {
            let message = format!("--transform and --prior of {}: one of them", map.display());
            return Err(UsageError(message));
        }
        let sigma =
            args.prior_sigma.map_or([0.0; 2], |sigma| [sigma.metres, sigma.degrees.to_radians()]);
        let given = Self { reference, exact, believed, sigma };
        if given.all().is_none() && given.exact[reference].is_some() {
            let name = maps[reference].display();
            let message = format!(
                "--transform of {name}, whose frame is kept where maps are searched for; \
                 give every map a pose, or {name} none"
            );
            return Err(UsageError(message));
        }
        Ok(given)
    }

    /// Poses of all maps, where all are known exactly; the reference is where it is unless said.
    pub(crate) fn all(&self) -> Option<Vec<Se2>> {
        let stays = |map| (map == self.reference).then(Se2::identity);
        let poses = self.exact.iter().enumerate().map(|(map, pose)| pose.or_else(|| stays(map)));
        self.exact.iter().any(Option::is_some).then(|| poses.collect()).flatten()
    }

    /// What is known of any of the maps.
    pub(crate) fn poses(&self) -> Vec<KnownPose> {
        let pose = |(map, pose): (usize, &Option<Se2>), [sigma_m, sigma_rad]: [f64; 2]| {
            pose.map(|reference_from_map| KnownPose { map, reference_from_map, sigma_m, sigma_rad })
        };
        let exact = self.exact.iter().enumerate().filter_map(|found| pose(found, [0.0; 2]));
        let believed = self.believed.iter().enumerate().filter_map(|found| pose(found, self.sigma));
        exact.chain(believed).collect()
    }

    /// What is believed of the second of two maps.
    pub(crate) fn prior(&self) -> Option<Prior> {
        let target_from_source = *self.believed.get(1)?.as_ref()?;
        let [sigma_m, sigma_rad] = self.sigma;
        Some(Prior { target_from_source, sigma_m, sigma_rad })
    }

    /// Whether anything exact is known.
    pub(crate) fn is_exact(&self) -> bool {
        self.exact.iter().any(Option::is_some)
    }
}
