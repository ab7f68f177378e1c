//! `[law]`: kind and parameters. A term whose parameter is not named is not computed.

use files::reader::{NOT_NEGATIVE, POSITIVE, Reader, RecipeError, Section};
use jam::laws::presets::PRESETS;
use jam::laws::{Algebraic, Exponential, Logarithmic, Model};

/// Width of the smooth ramp of the algebraic and exponential laws (text after eq:aTheta).
const EPSILON: f64 = 0.1;

/// Reads `[law]`.
///
/// # Errors
/// An unknown kind, preset or key, or a parameter out of its range.
pub fn read(file: &str, section: &Section) -> Result<Model, RecipeError> {
    let mut law = Reader::new(file, "law", section);
    let read = law.one_of("kind", &KINDS)?;
    let model = read(&mut law)?;
    law.finish()?;
    Ok(model)
}

/// Reads the parameters of a law.
type Parameters = fn(&mut Reader<'_>) -> Result<Model, RecipeError>;

/// The laws by name.
const KINDS: [(&str, Parameters); 3] =
    [("algebraic", algebraic), ("exponential", exponential), ("logarithmic", logarithmic)];

fn algebraic(law: &mut Reader<'_>) -> Result<Model, RecipeError> {
    if law.has("preset") {
        return preset(law);
    }
    Ok(Model::Algebraic(Algebraic {
        strength: law.number("mu", NOT_NEGATIVE)?,
        relative: law.optional_number("delta", NOT_NEGATIVE)?.unwrap_or(0.0),
        power: law.number("q", POSITIVE)?,
        widening: law.optional_number("a_v", NOT_NEGATIVE)?.unwrap_or(0.0),
        epsilon: law.optional_number("epsilon", POSITIVE)?.unwrap_or(EPSILON),
        desired_speed: law.number("v0", POSITIVE)?,
    }))
}

/// A model of tab:model; the parameters that it leaves open must be given, the others must not.
fn preset(law: &mut Reader<'_>) -> Result<Model, RecipeError> {
    let preset = law.one_of("preset", &PRESETS.map(|preset| (preset.name, preset)))?;
    let strength = if preset.strength.is_none() { law.number("mu", NOT_NEGATIVE)? } else { 0.0 };
    let widening = if preset.widening.is_none() { law.number("a_v", NOT_NEGATIVE)? } else { 0.0 };
    let epsilon = law.optional_number("epsilon", POSITIVE)?.unwrap_or(EPSILON);
    Ok(Model::Algebraic(preset.law(strength, widening, epsilon, law.number("v0", POSITIVE)?)))
}

fn logarithmic(law: &mut Reader<'_>) -> Result<Model, RecipeError> {
    Ok(Model::Logarithmic(Logarithmic {
        desired_speed: law.number("v0", POSITIVE)?,
        widening: law.optional_number("a_v", NOT_NEGATIVE)?.unwrap_or(0.0),
        epsilon: law.number("epsilon", POSITIVE)?,
    }))
}

fn exponential(law: &mut Reader<'_>) -> Result<Model, RecipeError> {
    Ok(Model::Exponential(Exponential {
        strength: law.number("a", NOT_NEGATIVE)?,
        range: law.number("b", POSITIVE)?,
        contact: law.optional_number("c", NOT_NEGATIVE)?.unwrap_or(0.0),
        widening: law.optional_number("a_v", NOT_NEGATIVE)?.unwrap_or(0.0),
        epsilon: law.optional_number("epsilon", POSITIVE)?.unwrap_or(EPSILON),
        desired_speed: law.number("v0", POSITIVE)?,
    }))
}
