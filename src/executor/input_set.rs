//! Inputs that stay on the device: frames to come back to, and inputs of several sessions at once.

use super::headless::HeadlessDevice;
use super::session::Session;
use super::session_objects::OwnedImage;
use super::Executor;
use crate::error::Error;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Images of inputs with their content. [`Session::bind_inputs`] takes microseconds where an upload takes milliseconds.
#[derive(Clone)]
pub struct InputSet {
    // Declared before `gpu`, so that they are dropped first.
    images: BTreeMap<String, Arc<OwnedImage>>,
    gpu: Arc<HeadlessDevice>,
}

impl InputSet {
    /// A set without images.
    pub fn new(gpu: Arc<HeadlessDevice>) -> Self {
        Self { images: BTreeMap::new(), gpu }
    }

    /// Whether an input is in the set.
    pub fn contains(&self, name: &str) -> bool {
        self.images.contains_key(name)
    }

    /// Adds the images that a session has bound now; those of the same names are replaced. Later
    /// uploads to the session go to new images.
    ///
    /// # Errors
    /// [`Error::NoDevice`] if the session is on a different device.
    pub fn add(&mut self, session: &Session) -> Result<(), Error> {
        self.check(session)?;
        self.images.extend(session.inputs.iter().map(|(name, image)| (name.clone(), image.clone())));
        Ok(())
    }

    /// Binds the images to those inputs of the same names that the declaration of an executor has.
    /// Keep the set alive as long as recorded work uses it.
    ///
    /// # Errors
    /// Errors of [`Executor::bind_image`].
    pub fn bind(&self, executor: &mut Executor) -> Result<(), Error> {
        for (name, image) in &self.images {
            if executor.denoiser().declaration().find(name).is_some() {
                executor.bind_image(name, image.uploaded())?;
            }
        }
        Ok(())
    }

    fn check(&self, session: &Session) -> Result<(), Error> {
        let same = Arc::ptr_eq(&self.gpu, &session.gpu);
        let message = "the inputs are on another device than the session; open both with the same HeadlessDevice";
        same.then_some(()).ok_or_else(|| Error::NoDevice(message.to_owned()))
    }
}

impl Session {
    /// Binds the images of a set to those inputs of the same names that the declaration has.
    ///
    /// # Errors
    /// Errors of [`Executor::bind_image`]; [`Error::NoDevice`] for a set of a different device.
    pub fn bind_inputs(&mut self, set: &InputSet) -> Result<(), Error> {
        set.check(self)?;
        self.settle()?;
        set.bind(&mut self.executor)?;
        let declaration = self.executor.denoiser().declaration();
        let bound = set.images.iter().filter(|(name, _)| declaration.find(name).is_some());
        self.inputs.extend(bound.map(|(name, image)| (name.clone(), image.clone())));
        Ok(())
    }
}
