//! One compiled compute shader, with what its SPIR-V says of it.

use std::borrow::Cow;

/// Largest number of bindings that a shader may have; their numbers are below [`NUMBERS`].
pub const MAX_BINDINGS: usize = 28;
/// Bits of `WIRED` and `present`.
pub const NUMBERS: u32 = 32;
/// Bytes of push constants that every device has.
pub const MAX_PUSH_BYTES: u32 = 128;
/// The specialisation constant whose bit i says that the graph gives binding i something.
pub const WIRED: &str = "WIRED";
/// The specialisation constant with the host's conventions, in the bits of the uniform block's flags.
pub const CONVENTIONS: &str = "CONVENTIONS";
/// The specialisation constant whose bit i says that binding i has an image of the host, in which the picture is a part.
pub const OF_HOST: &str = "OF_HOST";
/// Specialisation constants that are set for every shader that has them, and not by nodes.
pub const SET_FOR_ALL: [&str; 3] = [WIRED, CONVENTIONS, OF_HOST];
/// The push constant whose bit i says that the host bound binding i.
pub const PRESENT: &str = "present";
/// The push constant for the number of a level, or of a view.
pub const LEVEL: &str = "level";

/// A compiled compute shader.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Shader {
    /// Stem of its file, without `.comp`: `atrous`.
    pub stage: Cow<'static, str>,
    /// The stage, with the macros of a variant: `atrous_signals_2`.
    pub name: Cow<'static, str>,
    /// The module, in the order of this machine's bytes.
    pub spirv: Cow<'static, [u8]>,
    /// Invocations of a workgroup.
    pub workgroup: [u32; 3],
    /// Bindings of descriptor set 0, by number.
    pub bindings: Cow<'static, [ShaderBinding]>,
    /// Members of the push constants, by offset.
    pub members: Cow<'static, [PushMember]>,
    /// Specialisation constants, by identifier.
    pub constants: Cow<'static, [SpecialisationConstant]>,
}

/// One binding of descriptor set 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ShaderBinding {
    /// Number of the binding.
    pub number: u32,
    /// Name in the GLSL; of a block that of the instance.
    pub name: Cow<'static, str>,
    /// Kind of resource that stands there.
    pub kind: BindingKind,
    /// The shader can do without it.
    pub optional: bool,
}

/// The kind of resource at a binding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BindingKind {
    /// An image without a sampler, read by `texelFetch`.
    SampledImage(Component),
    /// A storage image of a format.
    StorageImage(TexelFormat, BindingAccess),
    /// A uniform block.
    UniformBuffer,
    /// A storage block.
    StorageBuffer(BindingAccess),
}

/// The numeric class of an image as a shader sees it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Component {
    /// Floating point or normalised: `texture2D` in GLSL.
    Float,
    /// Unsigned integer: `utexture2D` in GLSL.
    Uint,
}

/// The access of a shader to storage, by its qualifiers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BindingAccess {
    /// `readonly`.
    ReadOnly,
    /// `writeonly`.
    WriteOnly,
    /// Neither qualifier: read and written.
    ReadWrite,
}

/// Format qualifiers that need no device feature (capability `Shader` alone).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TexelFormat {
    /// Four floats.
    Rgba32f,
    /// Four halves.
    Rgba16f,
    /// One float.
    R32f,
    /// Four bytes, 0 to 1.
    Rgba8,
    /// Four unsigned integers.
    Rgba32ui,
    /// Four unsigned integers of 16 bits.
    Rgba16ui,
    /// One unsigned integer.
    R32ui,
}

/// A type of four bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scalar {
    /// 0 or 1.
    Bool,
    /// Signed.
    Int,
    /// Unsigned.
    Uint,
    /// Single precision.
    Float,
}

/// One member of the push constants.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PushMember {
    /// Name in the GLSL.
    pub name: Cow<'static, str>,
    /// Bytes from the start.
    pub offset: u32,
    /// Type of the member.
    pub scalar: Scalar,
}

/// One specialisation constant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SpecialisationConstant {
    /// Name in the GLSL.
    pub name: Cow<'static, str>,
    /// The `constant_id`.
    pub id: u32,
    /// Type of the constant.
    pub scalar: Scalar,
    /// The bits of its value where nothing sets it.
    pub default: u32,
}

impl BindingKind {
    /// Whether a descriptor of the other kind can stand here, where the shader does not read it.
    pub fn stands_in_for(self, other: Self) -> bool {
        match (self, other) {
            (Self::SampledImage(a), Self::SampledImage(b)) => a == b,
            (Self::StorageImage(a, _), Self::StorageImage(b, _)) => a == b,
            (Self::UniformBuffer, Self::UniformBuffer) | (Self::StorageBuffer(_), Self::StorageBuffer(_)) => true,
            _ => false,
        }
    }
}

impl Shader {
    /// A binding by its name.
    pub fn binding(&self, name: &str) -> Option<&ShaderBinding> {
        self.bindings.iter().find(|b| b.name == name)
    }

    /// A binding that is always there and whose descriptor can stand where an optional one has none.
    pub fn stand_in(&self, of: &ShaderBinding) -> Option<&ShaderBinding> {
        self.bindings.iter().find(|b| !b.optional && b.kind.stands_in_for(of.kind))
    }

    /// A specialisation constant by its name.
    pub fn constant(&self, name: &str) -> Option<&SpecialisationConstant> {
        self.constants.iter().find(|c| c.name == name)
    }

    /// Whether the push constants have a member.
    pub fn has_member(&self, name: &str) -> bool {
        self.members.iter().any(|m| m.name == name)
    }

    /// Bytes of the push constants.
    pub fn push_bytes(&self) -> u32 {
        self.members.iter().map(|m| m.offset + 4).max().unwrap_or(0)
    }

    /// Whether a pass can be made of it.
    ///
    /// # Errors
    /// Names what is wrong.
    pub fn check(&self) -> Result<(), String> {
        let name = &self.name;
        if self.bindings.len() > MAX_BINDINGS {
            return Err(format!("{name} has {} bindings; at most {MAX_BINDINGS} are allowed", self.bindings.len()));
        }
        for (i, binding) in self.bindings.iter().enumerate() {
            let ShaderBinding { number, name: of, .. } = binding;
            if *number >= NUMBERS {
                return Err(format!("{name}: binding {number}, `{of}`: numbers are 0 to {}", NUMBERS - 1));
            }
            if self.bindings[..i].iter().any(|b| b.number == *number || b.name == *of) {
                return Err(format!("{name}: binding {number}, `{of}`: another one has its number or its name"));
            }
            if binding.optional && self.stand_in(binding).is_none() {
                return Err(format!(
                    "{name}: `{of}` cannot be optional, since no other binding of its kind ({:?}) is always there to stand in for it; \
                     make a variant of its own",
                    binding.kind
                ));
            }
        }
        if self.bindings.iter().any(|b| b.optional) && (self.constant(WIRED).is_none() || !self.has_member(PRESENT)) {
            return Err(format!(
                "{name} has optional bindings, so it needs the constant {WIRED} and the push constant `{PRESENT}`"
            ));
        }
        if self.push_bytes() > MAX_PUSH_BYTES {
            return Err(format!("{name}: {} bytes of push constants; at most {MAX_PUSH_BYTES} are allowed", self.push_bytes()));
        }
        Ok(())
    }
}
